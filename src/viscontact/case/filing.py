"""Attributes of a result from its case file: title block, digests of files, values as typed."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from typing import Any

from viscontact.case.case import Case
from viscontact.case.errors import dotted
from viscontact.run_files import CASE_NAME


def case_attributes(case: Case) -> Mapping[str, Any]:
    """Return the attributes of a result that come from its case file, as JSON.

    `title_block`: section `report`; `input_files`: name, key and SHA-256 when read;
    `case_as_typed`; `measured`: tables of laws as measured; `allowable`: limits, to which verdicts
    are added later.
    """
    limits = {name: {"limit": limit} for name, limit in case.allowable.items()}
    sometimes = {"title_block": case.title_block, "measured": case.measured, "allowable": limits}
    return {
        **{name: json.dumps(value) for name, value in sometimes.items() if value},
        "input_files": json.dumps(_input_files(case)),
        "case_as_typed": json.dumps(case.document.data_with_tolerances, default=str),
    }


def _input_files(case: Case) -> list[dict[str, str]]:
    """Name, role and SHA-256 of each file of a case; the case file may differ from that as run."""
    typed, run = case.digests.get(case.document.path, b""), hashlib.sha256(case.text.encode())
    found = [_entry(CASE_NAME, "case as run", run.digest())]
    if typed and typed != run.digest():
        found.insert(0, _entry(case.document.path.name, "case file", typed))
    named = {path: dotted(key) for key, path in case.files.items()}
    files = (_entry(case.file_names[path], named[path], case.digests[path]) for path in named)
    return [*found, *sorted(files, key=lambda entry: entry["role"])]


def _entry(name: str, role: str, digest: bytes) -> dict[str, str]:
    return {"name": name, "role": role, "sha256": digest.hex()}
