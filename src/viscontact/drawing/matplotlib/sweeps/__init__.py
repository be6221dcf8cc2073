"""Figures of the runs of a sweep."""
