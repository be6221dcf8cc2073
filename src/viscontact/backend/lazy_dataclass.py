"""Dataclasses whose methods are made at their first use.

Python compiles the methods of a dataclass from text, 0.4 ms for each class, which was a fifth of
the start of a command: of most of the classes that it imports, it never makes an object.
"""

from __future__ import annotations

import dataclasses
import inspect
import sys
from collections.abc import Callable, Iterable
from functools import partial
from threading import RLock
from typing import TYPE_CHECKING, Any

#: What describes a dataclass: `dataclasses.fields`, patterns, `inspect` and `copy` ask for it.
_DESCRIPTIONS = (
    *("__dataclass_fields__", "__dataclass_params__", "__match_args__", "__signature__"),
    *(("__replace__",) if sys.version_info >= (3, 13) else ()),
)
#: Two threads may use a class for the first time at once; its bases are made meanwhile.
_MAKING = RLock()


class _AtFirstUse:
    """Attribute of a dataclass before it is made: asked for, it makes them all."""

    def __init__(self, name: str, of: type, make: Callable[[], None]) -> None:
        self.name, self.of, self.make = name, of, make

    def __get__(self, instance: object, owner: type) -> Any:
        with _MAKING:
            if vars(self.of).get(self.name) is self:  # not made by another thread meanwhile
                self.make()
        if self.name == "__signature__":  # of which a dataclass has none
            if instance is not None:
                raise AttributeError(self.name)
            return inspect.signature(owner)
        made = getattr(self.of, self.name)
        return made.__get__(instance, owner) if inspect.isfunction(made) else made


def _lazy_dataclass(
    cls: type | None = None,
    /,
    *,
    init: bool = True,
    repr: bool = True,
    eq: bool = True,
    frozen: bool = False,
    kw_only: bool = False,
) -> Any:
    options = {"init": init, "repr": repr, "eq": eq, "frozen": frozen, "kw_only": kw_only}
    if cls is None:
        return partial(_lazy_dataclass, **options)
    body = dict(vars(cls))
    if "__eq__" in body and body.get("__hash__", ...) is None:
        del body["__hash__"]  # Python has set it; the decorator takes it for none
    methods = {"__init__": init, "__repr__": repr, "__eq__": eq, "__hash__": eq and frozen}
    missing = [name for name, is_wanted in methods.items() if is_wanted and name not in body]
    missing += _DESCRIPTIONS
    for name, given in body.items():
        if isinstance(given, dataclasses.Field):  # a class has the default of a field, or nothing
            _set_or_delete(cls, name, given.default)
    make = partial(_make, cls, body, options, missing)
    for name in missing:
        setattr(cls, name, _AtFirstUse(name, cls, make))
    if eq and not frozen and "__hash__" not in body:
        cls.__hash__ = None  # type: ignore[assignment]
    if frozen:
        _freeze(cls)
    return cls


def _make(
    cls: type, body: dict[str, Any], options: dict[str, bool], missing: Iterable[str]
) -> None:
    """Take what is missing from a twin of the class, so that no other thread finds it without."""
    same = {name: each for name, each in body.items() if name not in ("__dict__", "__weakref__")}
    same["__qualname__"] = cls.__qualname__
    made = vars(dataclasses.dataclass(**options)(type(cls)(cls.__name__, cls.__bases__, same)))
    for name in missing:
        _set_or_delete(cls, name, made.get(name, dataclasses.MISSING))


def _set_or_delete(cls: type, name: str, value: object) -> None:
    if value is dataclasses.MISSING:
        delattr(cls, name)
    else:
        setattr(cls, name, value)


def _freeze(cls: Any) -> None:
    """Refuse assignments to objects of the class, and to its fields in those of others."""

    def refuse(of: object, name: str, what: str) -> None:
        if type(of) is cls or name in {field.name for field in dataclasses.fields(cls)}:
            raise dataclasses.FrozenInstanceError(f"cannot {what} field {name!r}")

    def set_attribute(self: object, name: str, value: object) -> None:
        refuse(self, name, "assign to")
        super(cls, self).__setattr__(name, value)

    def delete_attribute(self: object, name: str) -> None:
        refuse(self, name, "delete")
        super(cls, self).__delattr__(name)

    cls.__setattr__, cls.__delattr__ = set_attribute, delete_attribute


if TYPE_CHECKING:  # but for the time, it is that of the standard library
    from dataclasses import dataclass as dataclass
else:
    dataclass = _lazy_dataclass
