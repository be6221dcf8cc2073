"""Passes over the cells of a patch: what the search for a pressure does cell by cell."""
