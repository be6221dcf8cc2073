"""Leakage: flow of a fluid through the gap of a contact."""
