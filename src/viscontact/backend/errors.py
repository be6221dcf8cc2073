"""Warnings and exceptions of runs."""

from __future__ import annotations

from typing import Any


class AccuracyWarning(UserWarning):
    """Warning that a result is usable, but less accurate than expected.

    Examples
    --------
    >>> import warnings
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> coarse = vc.Grid((8, 8), (4e-3, 4e-3))
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("ignore", AccuracyWarning)
    ...     ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(1.0), coarse, [0.0], errors=False)
    >>> ds.attrs["warnings"][:18]  # also kept in the result
    'only 6 cells lie a'
    """


class CoreError(ImportError):
    """The environment asks for a compiled core that is not there, or in unknown words."""


class RunError(RuntimeError):
    """Base of the exceptions of a run that stops after its first step.

    Attributes
    ----------
    partial : xarray.Dataset or None
        The steps completed before the run stopped, or None if there are none. After a
        ConvergenceError the last one may be the failed one, as its outcome shows.
    """

    def __init__(self, message: str, partial: Any = None) -> None:
        super().__init__(message)
        self.partial = partial


class ConvergenceError(RunError):
    """The contact solver has not reached the tolerance in a step.

    Attributes
    ----------
    partial : xarray.Dataset or None
        The completed steps, or None if there are none. The last one may be the failed one, as its
        ``outcome`` shows.

    Examples
    --------
    >>> error = ConvergenceError("stopped at t = 2 s")
    >>> error.partial is None  # no step was completed
    True
    """


class SlidingError(ConvergenceError):
    """The prescribed load along the surface exceeds what friction carries: the body slides away."""


class DomainError(RunError):
    """The grid does not fit the contact: pressure at its edge, or too few cells across.

    Attributes
    ----------
    partial : xarray.Dataset or None
        The completed steps, or None if there are none.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> small = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> try:
    ...     vc.simulate(vc.Sphere(0.01), rubber, vc.step(1.0), small, [0.0])
    ... except DomainError as error:
    ...     print(error.partial is None)
    True
    """


#: Messages of the dynamic loader, Rust, HDF5 and NumPy when something does not fit into memory.
_NO_ROOM = (
    "failed to map segment",
    "annot allocate memory",
    "emory allocation",
    "nable to allocate",
)


def is_lack_of_memory(error: BaseException | str | None) -> bool:
    """Return whether an error, one that caused it, or the text of one says that memory is missing.

    >>> is_lack_of_memory("memory allocation of 8 bytes failed"), is_lack_of_memory(ValueError("0"))
    (True, False)
    """
    if isinstance(error, str):
        return any(text in error for text in _NO_ROOM)
    while error is not None:
        if isinstance(error, MemoryError) or is_lack_of_memory(str(error)):
            return True
        error = error.__cause__ or error.__context__
    return False
