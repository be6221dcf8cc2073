"""Command `fit --case`: its options as arguments of `viscontact.fit_case`, and its result."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from viscontact.backend.errors import AccuracyWarning
from viscontact.cli.material.fit_kinds import switch
from viscontact.cli.material.fit_options import FitArguments
from viscontact.cli.material.fit_report import DeferredFigure, draw_fit, write_section
from viscontact.cli.studies.execution import Records, performed, write_report
from viscontact.cli.studies.typed_options import by_key, case_of, settings_of
from viscontact.cli.terminal.messages import put, refuse, say
from viscontact.studies.calibration.fit_case import fit_case
from viscontact.studies.calibration.record import ContactRecord, read_record
from viscontact.studies.calibration.result import CaseFit
from viscontact.studies.typed_values import bounds


def execute_case_fit(typed: Mapping[str, Any], width: str | float | None) -> None:
    """Fit values of a case by options of the command; print, draw and write them."""
    others = ["table"] if typed["table"] is not None else []
    given = [each for each in FitArguments.of(typed).given if each != "columns"]
    if idle := [switch(each) for each in (*given, *others)]:
        refuse(
            f"{', '.join(idle)} does not go with --case, whose file has body and law; leave it out"
        )
    trials = Path(f"{typed['files'][0].stem}-fit.jsonl")
    found = _fit(typed, trials)
    put(found)
    for note in found.notes:
        say(f"warning: {note}")
    text = found.section_text
    put(f"\n{text}", end="")
    if typed["output"] is not None:
        draw_fit(DeferredFigure("fitted_records", found.curves), typed["output"], width)
    if typed["section"] is not None:
        write_section(typed["section"], text)
    if typed["report"] is not None:
        write_report(found, typed["report"])


def _arguments(typed: Mapping[str, Any]) -> dict[str, Any]:
    """Arguments of `viscontact.fit_case` by name."""
    if not typed["change"]:
        refuse("--change: name an unknown, e.g. --change material.shear_modulus='1 MPa:9 MPa'")
    remedy = "KEY=LOW:HIGH or KEY=LOW:HIGH:log, with units"
    ranges = {name: typed[name] for name in ("contact_point", "machine_stiffness")}
    return {
        "case": case_of(typed),
        **{name: typed[name] for name in ("drive", "rows", "runs") if typed[name] is not None},
        "change": by_key("--change", typed["change"], remedy, bounds),
        **{name: text if text is None else bounds(text) for name, text in ranges.items()},
        "settings": settings_of(typed["settings"]),
    }


def _records(typed: Mapping[str, Any]) -> list[ContactRecord] | list[Path]:
    """Records of the files; read here if the names of their columns are given."""
    files: list[Path] = typed["files"]
    names = typed["columns"]
    return files if names is None else [read_record(file, names) for file in files]


def _fit(typed: Mapping[str, Any], trials: Path) -> CaseFit:
    """Result of a fit, which keeps its runs in a file up to its end."""
    arguments, begun = _arguments(typed), trials.exists()

    def fit(**how: Any) -> CaseFit:
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", AccuracyWarning)  # printed from the notes
                return fit_case(records=_records(typed), **arguments, trials=trials, **how)
        except ValueError:
            if not begun:
                trials.unlink(missing_ok=True)
            raise

    found = performed(fit, Records(trials, trials), typed)
    trials.unlink(missing_ok=True)
    return found
