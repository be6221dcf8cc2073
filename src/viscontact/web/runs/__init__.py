"""Runs of the calculator page: queue, status, live scalars."""
