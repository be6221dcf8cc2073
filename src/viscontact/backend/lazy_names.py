"""Names of a package that are loaded at their first use, listed in its stub."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import lazy_loader

_IMPORT = re.compile(
    r"^from \.(?P<module>[\w.]*) import (?:\((?P<several>[^)]*)\)|(?P<one>.*))$", re.MULTILINE
)
_NAME = re.compile(r"(\w+)(?: as \w+)?")

#: `__getattr__`, `__dir__` and `__all__` of a package.
_Attached = tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]


def attach_stub(package: str, file: str) -> _Attached:
    """Return `__getattr__`, `__dir__` and `__all__` of a package by the stub beside its file."""
    # As `attach_stub` of lazy_loader, which takes half a millisecond to read each stub as Python.
    modules, names = stub_names(Path(file).with_suffix(".pyi").read_text(encoding="utf-8"))
    attached: _Attached = lazy_loader.attach(package, modules, names)
    return attached


def stub_names(stub: str) -> tuple[set[str], dict[str, list[str]]]:
    """Modules that a stub imports, and the names that it imports from others."""
    modules: set[str] = set()
    names: dict[str, list[str]] = {}
    for found in _IMPORT.finditer(stub):
        listed = _NAME.findall(found["several"] or found["one"])
        if found["module"]:
            names.setdefault(found["module"], []).extend(listed)
        else:
            modules.update(listed)
    return modules, names
