"""Preparation of a calibration: records, unknowns and cases, checked before the first run."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path

import numpy as np

from viscontact.bodies.grid import Grid
from viscontact.case import Case
from viscontact.studies.calibration.record import ContactRecord, Drive, chosen_drive, read_record
from viscontact.studies.calibration.response import Experiment, cells_of
from viscontact.studies.calibration.unknowns import Unknown, case_settings
from viscontact.studies.case_values import case_with
from viscontact.units.formatting import format_quantity

#: A record, or the table that it is read from.
Record = ContactRecord | str | PathLike[str]


def read_records(records: Record | Sequence[Record]) -> list[ContactRecord]:
    """Read the records that are given as tables."""
    several = [records] if isinstance(records, ContactRecord | str | PathLike) else list(records)
    if not several:
        raise ValueError("records: name a table, or give a ContactRecord")
    return [r if isinstance(r, ContactRecord) else read_record(r) for r in several]


def require_at_rest(path: Path, case: Case) -> None:
    """Raise ValueError if the body of a case moves."""
    if not case.motion.stands:
        raise ValueError(
            f"{path}: its body moves over the surface; a fit takes a body that is pressed at rest"
        )


def check_bounds(path: Path, fixed: Mapping[str, str], unknowns: Sequence[Unknown]) -> None:
    """Check the case with each unknown at its bounds, the others at their starts."""
    starts = np.array([each.start for each in unknowns])
    for number in range(len(unknowns)):
        for end in (0.0, 1.0):
            point = starts.copy()
            point[number] = end
            case_with(path, {**fixed, **case_settings(unknowns, point)})


def experiment_of(
    path: Path,
    fixed: Mapping[str, str],
    case: Case,
    record: ContactRecord,
    wanted: str | None,
    number: int = 0,
) -> Experiment:
    """Experiment of a record; ValueError if the case does not describe it."""
    control = case.load.control
    if control == "mixed":
        raise ValueError(
            f"{path}: its load prescribes force and approach in turn; a fit takes one of "
            "them, as load.kind: step"
        )
    drive: Drive = chosen_drive(record, control, wanted)
    if case.tangential is not None and drive != "case":
        raise ValueError(
            f"{path}: tangential: its times are those of the case, and the {drive} that is "
            "prescribed has those of the record; leave out tangential, or take the load of the "
            "case: drive='case' (--drive case)"
        )
    if drive == "case":
        _require_within(case, record)
    _require_approach(path, case, control if drive == "case" else drive, record)
    own, coarse = cells_of(case, record, drive)
    compared_approach = (drive == "case" and control == "force") or drive == "force"
    if compared_approach and not case.has_datum(own):
        raise ValueError(
            f"{path}: the approach of a line contact has no datum, and cannot be fitted; give the "
            "body a thickness or layers"
        )
    may_grow = not isinstance(case.grid, Grid)
    return Experiment(path, fixed, record, drive, control, own, coarse, may_grow, number)


def require_rows(experiments: Sequence[Experiment], unknowns: Sequence[Unknown]) -> None:
    """Raise ValueError if there are fewer rows than twice the unknowns."""
    rows = sum(each.record.times.size for each in experiments)
    if rows < 2 * len(unknowns):
        raise ValueError(
            f"records: {len(unknowns)} unknowns need at least {2 * len(unknowns)} rows, got {rows}"
        )


def digest(record: ContactRecord) -> str:
    """SHA-256 of the columns of a record."""
    columns = (record.times, *(record.column(name) for name in record.columns))
    return hashlib.sha256(b"".join(each.tobytes() for each in columns)).hexdigest()


def _require_approach(path: Path, case: Case, prescribed: str, record: ContactRecord) -> None:
    """Raise ValueError where bodies that adhere are given a force, or a stage without force."""
    if case.adhesion is None:
        return
    if prescribed == "force":
        raise ValueError(
            f"{path}: with adhesion, runs under a given force end where the bodies are pulled off; "
            "let the approach drive them, as with load.kind: history of approach"
        )
    if "force" not in record.columns:
        raise ValueError(f"{record.name}: needs a column force, which adhesion is fitted to")


def _require_within(case: Case, record: ContactRecord) -> None:
    """Raise ValueError if a time of the record is not one of a run of the case."""
    end = float(case.adaptive.end if case.adaptive is not None else case.instants[-1])
    outside = (record.times < 0) | (record.times > end * (1 + 1e-9))
    if outside.any():
        row = int(np.argmax(outside))
        raise ValueError(
            f"{record.name}: time {format_quantity(float(record.times[row]), 's')} lies outside "
            f"the load of the case, which ends at {format_quantity(end, 's')}; set time.end, or "
            "give the record a column of the prescribed quantity"
        )
