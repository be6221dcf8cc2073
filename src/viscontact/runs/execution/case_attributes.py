"""Contents of a case file that its result keeps."""

from __future__ import annotations

import hashlib

from viscontact.case.case import Case
from viscontact.case.errors import dotted
from viscontact.results.filed_case import FiledCase
from viscontact.results.run_files import CASE_NAME


def filed_case(case: Case) -> FiledCase:
    """Return what a result keeps of a case."""
    return FiledCase(
        case.title_block,
        _input_files(case),
        case.document.data_with_tolerances,
        case.measured,
        case.allowable,
    )


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
