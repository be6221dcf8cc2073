"""What can go wrong, by name."""

from __future__ import annotations

from typing import Any


class AccuracyWarning(UserWarning):
    """The result stands, but something about it is coarser than a user would expect."""


class RunError(RuntimeError):
    """A run that stopped after its first step.

    Attributes
    ----------
    partial : xarray.Dataset or None
        The steps completed before the run stopped, or None if there are none to give. After a
        ConvergenceError the last one may be the failed one; its outcome says so.
    """

    def __init__(self, message: str, partial: Any = None) -> None:
        super().__init__(message)
        self.partial = partial


class ConvergenceError(RunError):
    """The contact solver stopped short of the tolerance at some step."""


class DomainError(RunError):
    """The grid does not fit the contact: pressure at its rim, or too few cells across."""
