"""Argument checks, and warnings about accuracy and validity."""
