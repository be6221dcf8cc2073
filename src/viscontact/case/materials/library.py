"""Materials that a case file may give by name."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from viscontact.materials import library


class _Sections(Mapping[str, dict[str, Any]]):
    """The `material` sections of the shipped library by name, each read when asked for."""

    def __getitem__(self, name: str) -> dict[str, Any]:
        entry = library.entry(name)
        # A run that goes beyond what is known of it warns.
        return {**entry.material, "measured_until": f"{entry.measured[1]!r} s"}

    def __iter__(self) -> Iterator[str]:
        return iter(library.names())

    def __len__(self) -> int:
        return len(library.names())

    def __contains__(self, name: object) -> bool:
        return name in library.names()


MATERIALS: Mapping[str, dict[str, Any]] = _Sections()
