"""Installed versions of the packages that viscontact needs, and of those of its extras."""

from __future__ import annotations

import re
from collections import Counter
from importlib.metadata import PackageNotFoundError, requires, version
from itertools import chain

from viscontact.backend.lazy_dataclass import dataclass

#: Extras for developers, and those that contain others.
_NOT_FOR_USERS = ("all", "dev", "docs", "test")


@dataclass(frozen=True)
class Package:
    """Package that viscontact needs, or that extras add."""

    name: str
    extras: tuple[str, ...]  # the smallest one first; empty for a package that is always needed
    installed: str | None  # version, None where it is missing


def packages() -> tuple[Package, ...]:
    """Return the packages that viscontact and its extras need, with their installed versions."""
    extras: dict[str, set[str]] = {}
    for requirement in requires("viscontact") or ():
        name = re.split(r"[\[<>=!~; ]", requirement)[0]
        chosen = re.search(r"extra == ['\"]([\w-]+)['\"]", requirement)
        if name != "viscontact" and not (chosen and chosen[1] in _NOT_FOR_USERS):
            extras.setdefault(name, set()).update([chosen[1]] if chosen else [])
    sizes = Counter(chain.from_iterable(extras.values()))

    def by_size(of: set[str]) -> tuple[str, ...]:
        return tuple(sorted(of, key=lambda extra: (sizes[extra], extra)))

    found = (Package(name, by_size(of), _installed(name)) for name, of in extras.items())
    return tuple(sorted(found, key=lambda package: (package.extras, package.name)))


def _installed(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None
