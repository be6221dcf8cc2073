"""Title block, date, input files and typed values that a result keeps of its case."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from typing import Any

import xarray as xr


def title_block(ds: xr.Dataset) -> Mapping[str, str]:
    """Entries of the title block, by name; empty without any.

    >>> title_block(xr.Dataset(attrs={"title_block": '{"project": "P-7"}'}))
    {'project': 'P-7'}
    """
    found = _attribute(ds, "title_block", dict)
    return {str(name): str(value) for name, value in found.items()}


def input_files(ds: xr.Dataset) -> Sequence[Mapping[str, str]]:
    """Name, role and SHA-256 of each input file when it was read; empty for a run from Python."""
    found: list[Mapping[str, str]] = _attribute(ds, "input_files", list)
    return found


def typed_case(ds: xr.Dataset) -> Mapping[str, Any]:
    """Values of the case file as they were typed; empty for a run from Python."""
    found: dict[str, Any] = _attribute(ds, "case_as_typed", dict)
    return found


def measured_tables(ds: xr.Dataset) -> Mapping[str, Any]:
    """Tables of the laws in the quantities that were measured, by the section of the material."""
    found: dict[str, Any] = _attribute(ds, "measured", dict)
    return found


def started_at(ds: xr.Dataset) -> str:
    """Date and time of the start of a run, local with its offset and in UTC; empty if unknown.

    >>> started_at(xr.Dataset(attrs={"started": "2026-03-01T00:30:05+00:00"}))
    '2026-03-01 00:30:05 UTC'
    >>> started_at(xr.Dataset(attrs={"started": "2026-03-01T00:30:05+01:00"}))
    '2026-03-01 00:30:05 +01:00 (2026-02-28 23:30:05 UTC)'
    """
    try:
        moment = datetime.fromisoformat(str(ds.attrs.get("started", "")))
    except ValueError:
        return ""
    if moment.tzinfo is None:
        return ""
    in_utc = f"{moment.astimezone(UTC):%Y-%m-%d %H:%M:%S} UTC"
    if not moment.utcoffset():
        return in_utc
    plain, zone = moment.isoformat(" ", "seconds")[:19], moment.isoformat()[-6:]
    return f"{plain} {zone} ({in_utc})"


def _attribute(ds: xr.Dataset, name: str, kind: type) -> Any:
    """Content of a JSON attribute; an empty one where it is missing or of another kind."""
    try:
        found = json.loads(str(ds.attrs.get(name, "")))
    except ValueError:
        return kind()
    return found if isinstance(found, kind) else kind()
