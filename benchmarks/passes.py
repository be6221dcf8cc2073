"""Count passes over memory and new arrays, by instrumented NumPy arrays.

Within the context `counted`, arrays that NumPy creates for the package report every ufunc, NumPy
function, assignment and copy that reads or writes them; transforms report their arguments. The
bytes are those of these arrays: temporary memory inside NumPy functions and the effect of caches
are not included. Views cost nothing, and broadcast axes count once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from viscontact.backend.transforms import Transforms

#: Functions that create arrays, or return them without their subclass.
MADE = ("zeros", "empty", "ones", "full", "array", "asarray", "ascontiguousarray", "empty_like")
TRANSFORMS = (
    "real_forward",
    "real_inverse",
    "complex_forward",
    "complex_inverse",
    "cosine_forward",
    "cosine_inverse",
)

#: Called with the bytes moved and the bytes of a new array (0: none).
Report = Callable[[int, int], None]


@dataclass
class _Listener:
    report: Report | None = None


_LISTENER = _Listener()


class TracedArray(np.ndarray):
    """Array that reports the operations on it."""

    def __array_ufunc__(
        self, ufunc: Any, method: str, *inputs: Any, out: Any = None, **options: Any
    ) -> Any:
        if out is not None:
            options["out"] = tuple(map(plain, out))
        options = plain(options)
        result = getattr(ufunc, method)(*map(plain, inputs), **options)
        report([*inputs, options.get("where")], result, is_new=out is None)
        return out[0] if out is not None and len(out) == 1 else traced(result)

    def __array_function__(self, function: Any, types: Any, args: Any, kwargs: Any) -> Any:
        arrays = list(arrays_in((args, kwargs)))
        result = function(*plain(args), **plain(kwargs))
        if not any(shares(result, each) for each in arrays):
            report(arrays, result, is_new=True)
        return traced(result)

    def __getitem__(self, index: Any) -> Any:
        result = plain(self)[plain(index)]
        if not shares(result, self):
            report([result], result, is_new=True)
        return traced(result)

    def __setitem__(self, index: Any, value: Any) -> None:
        index = plain(index)
        plain(self)[index] = plain(value)
        report([value], plain(self)[index], is_new=False)

    def copy(self, order: str = "C") -> Any:
        result = plain(self).copy(order)
        report([self], result, is_new=True)
        return traced(result)

    def astype(self, kind: Any, **options: Any) -> Any:
        result = plain(self).astype(kind, **options)
        report([self], result, is_new=True)
        return traced(result)


def is_array(value: Any) -> bool:
    return isinstance(value, np.ndarray) and value.ndim > 0


def traced(value: Any) -> Any:
    return value.view(TracedArray) if is_array(value) and value.dtype != object else value


def plain(value: Any) -> Any:
    """Return a value with plain arrays in place of instrumented ones."""
    if isinstance(value, TracedArray):
        return value.view(np.ndarray)
    if type(value) in (tuple, list):
        return type(value)(map(plain, value))
    return {key: plain(each) for key, each in value.items()} if type(value) is dict else value


def arrays_in(value: Any) -> Iterator[np.ndarray]:
    if is_array(value):
        yield value
    elif isinstance(value, dict):
        yield from arrays_in(tuple(value.values()))
    elif isinstance(value, tuple | list):
        for each in value:
            yield from arrays_in(each)


def shares(result: Any, array: np.ndarray) -> bool:
    return is_array(result) and bool(np.may_share_memory(plain(result), plain(array)))


def report(read: list[Any], result: Any, *, is_new: bool, is_written: bool = True) -> None:
    if _LISTENER.report is None:
        return
    moved = [*read, result] if is_written else read
    new = size_of(result) if is_new and is_array(result) else 0
    _LISTENER.report(sum(size_of(each) for each in moved if is_array(each)), new)


def size_of(array: np.ndarray) -> int:
    """Bytes of an array; broadcast axes count once."""
    counts = (n for n, stride in zip(array.shape, array.strides, strict=True) if stride)
    return array.itemsize * int(np.prod(list(counts)))


@contextmanager
def counted(listener: Report) -> Iterator[None]:
    """Report all operations on arrays created within the context to the listener."""
    replaced: list[tuple[Any, str, Any]] = []

    def replace(owner: Any, name: str, by: Callable[..., Any]) -> None:
        replaced.append((owner, name, getattr(owner, name)))
        setattr(owner, name, by)

    for name in MADE:
        replace(np, name, _making(getattr(np, name)))
    for kind in Transforms.__subclasses__():
        for name in TRANSFORMS:
            replace(kind, name, _transforming(getattr(kind, name)))
    _LISTENER.report = listener
    try:
        yield
    finally:
        _LISTENER.report = None
        for owner, name, original in reversed(replaced):
            setattr(owner, name, original)


def _making(make: Callable[..., Any]) -> Callable[..., Any]:
    def made(*args: Any, **kwargs: Any) -> Any:
        result = make(*plain(args), **plain(kwargs))
        given = list(arrays_in(args))
        if make.__name__.startswith("empty"):
            report([], result, is_new=True, is_written=False)
        elif not any(shares(result, each) for each in given):
            report(given, result, is_new=True)
        return traced(result)

    return made


def _transforming(transform: Callable[..., Any]) -> Callable[..., Any]:
    def transformed(self: Any, field: Any, *rest: Any, **kwargs: Any) -> Any:
        result = transform(self, plain(field), *plain(rest), **plain(kwargs))
        known = [field, *arrays_in(rest)]
        is_new = not any(shares(result, each) for each in known)
        report([field], result, is_new=is_new)
        return traced(result)

    return transformed
