"""Threads of the numerical libraries."""

from __future__ import annotations

from numpy import linalg as numpy_linalg
from threadpoolctl import threadpool_limits

#: Module that loads a library of linear algebra: a limit holds for loaded ones only.
_LOADED = numpy_linalg


def limit_threads(threads: int = 1) -> threadpool_limits:
    """Limit linear algebra and OpenMP to a number of threads; reverts as a context manager."""
    from scipy import linalg as scipy_linalg

    _ = scipy_linalg  # which has a library of its own
    return limit_loaded(threads)


def limit_loaded(threads: int = 1) -> threadpool_limits:
    """Limit the libraries that are loaded, NumPy's among them, for work that needs no other one."""
    # Inner products over a contact are too short for several threads. The call takes 6 ms. Fourier
    # transforms have threads of their own.
    return threadpool_limits(limits=threads)
