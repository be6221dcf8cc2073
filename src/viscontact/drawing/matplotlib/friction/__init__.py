"""Figures of contacts under friction."""
