"""Threads of the numerical libraries."""

from __future__ import annotations

from numpy import linalg as numpy_linalg
from scipy import linalg as scipy_linalg
from threadpoolctl import threadpool_limits

#: Modules that load a library of linear algebra each: a limit holds for loaded ones only.
_LOADED = (numpy_linalg, scipy_linalg)


def limit_threads(threads: int = 1) -> threadpool_limits:
    """Limit linear algebra and OpenMP to a number of threads in this process.

    Inner products over a contact are too short for several threads. Call it once in a worker (it
    takes 6 ms), or use it as a context manager, which restores the earlier limits. The threads of
    a run are those of its Fourier transforms, which have no limit here.

    >>> from threadpoolctl import threadpool_info
    >>> with limit_threads():
    ...     {library["num_threads"] for library in threadpool_info()}
    {1}
    """
    return threadpool_limits(limits=threads)
