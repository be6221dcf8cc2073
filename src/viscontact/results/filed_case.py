"""Contents of a case file that a result keeps in its attributes, and the start of its run."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import field
from datetime import UTC, datetime
from typing import Any, Self

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.variables import ALLOWABLE

#: Attributes as JSON, each with the type of its content.
_TYPES = {"title_block": dict, "measured": dict, "input_files": list, "case_as_typed": dict}


@dataclass(frozen=True)
class FiledCase:
    """Contents of a case file that a result keeps; empty for a run from Python."""

    #: Entries of the section `report`, by name.
    title_block: Mapping[str, str] = field(default_factory=dict)
    #: Name, role (or key) and SHA-256 of each input file when it was read.
    input_files: Sequence[Mapping[str, str]] = ()
    #: All values as they were typed.
    case_as_typed: Mapping[str, Any] = field(default_factory=dict)
    #: Tables of the laws in the quantities that were measured, by the section of the material.
    measured: Mapping[str, Any] = field(default_factory=dict)
    #: Limits in SI units, to which the verdicts are added when the run is finished.
    limits: Mapping[str, float] = field(default_factory=dict)

    @property
    def attributes(self) -> dict[str, str]:
        """Attributes of a result, without those that are empty in most cases."""
        limits = {name: {"limit": limit} for name, limit in self.limits.items()}
        sometimes = {"title_block": self.title_block, "measured": self.measured, ALLOWABLE: limits}
        return {
            **{name: json.dumps(value) for name, value in sometimes.items() if value},
            "input_files": json.dumps(self.input_files),
            "case_as_typed": json.dumps(self.case_as_typed, default=str),
        }

    @classmethod
    def of(cls, attributes: Mapping[str, Any]) -> Self:
        """Return what the attributes of a result keep, without the limits."""
        found = {name: _content(attributes, name, kind) for name, kind in _TYPES.items()}
        entries = {str(name): str(value) for name, value in found.pop("title_block").items()}
        return cls(entries, **found)


def _content(attributes: Mapping[str, Any], name: str, kind: type) -> Any:
    """Content of a JSON attribute; an empty one where it is missing or of another kind."""
    try:
        found = json.loads(str(attributes.get(name, "")))
    except ValueError:
        return kind()
    return found if isinstance(found, kind) else kind()


def started_at(attributes: Mapping[str, Any]) -> str:
    """Date and time of the start of a run, local with its offset and in UTC; empty if unknown."""
    try:
        moment = datetime.fromisoformat(str(attributes.get("started", "")))
    except ValueError:
        return ""
    if moment.tzinfo is None:
        return ""
    in_utc = f"{moment.astimezone(UTC):%Y-%m-%d %H:%M:%S} UTC"
    if not moment.utcoffset():
        return in_utc
    plain, zone = moment.isoformat(" ", "seconds")[:19], moment.isoformat()[-6:]
    return f"{plain} {zone} ({in_utc})"
