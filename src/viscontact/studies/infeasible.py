"""Error of a study without a result."""

from __future__ import annotations


class InfeasibleError(ValueError):
    """A study has no result: none of its runs keeps what is requested."""
