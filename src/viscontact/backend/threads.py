"""Threads of the numerical libraries."""

from __future__ import annotations

from numpy import linalg as numpy_linalg
from scipy import linalg as scipy_linalg
from threadpoolctl import threadpool_limits

#: Modules that load a library of linear algebra each: a limit holds for loaded ones only.
_LOADED = (numpy_linalg, scipy_linalg)


def limit_threads(threads: int = 1) -> threadpool_limits:
    """Limit linear algebra and OpenMP to a number of threads; reverts as a context manager."""
    # Inner products over a contact are too short for several threads. The call takes 6 ms. Fourier
    # transforms have threads of their own.
    return threadpool_limits(limits=threads)
