"""What can go wrong, by name."""

from __future__ import annotations

from typing import Any


class AccuracyWarning(UserWarning):
    """The result stands, but something about it is coarser than a user would expect.

    Examples
    --------
    >>> import warnings
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> coarse = vc.Grid((8, 8), (4e-3, 4e-3))
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("ignore", AccuracyWarning)
    ...     ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(1.0), coarse, [0.0], errors=False)
    >>> ds.attrs["warnings"][:18]  # which stays with the result
    'only 6 cells lie a'
    """


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
    """The contact solver stopped short of the tolerance at some step.

    Attributes
    ----------
    partial : xarray.Dataset or None
        The steps until then, or None if there are none. The last may be the failed one; its
        ``outcome`` says so.

    Examples
    --------
    >>> error = ConvergenceError("stopped at t = 2 s")
    >>> error.partial is None  # nothing was completed before
    True
    """


class DomainError(RunError):
    """The grid does not fit the contact: pressure at its rim, or too few cells across.

    Attributes
    ----------
    partial : xarray.Dataset or None
        The steps until then, or None if there are none.

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
