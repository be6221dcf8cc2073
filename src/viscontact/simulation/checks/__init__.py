"""Argument checks, and accuracy warnings as dicts of kind to sentence, empty if there is none."""
