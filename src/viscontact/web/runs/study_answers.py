"""Answer of a study, for the page: table of its runs, figures and notes; files; case of a run."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from typing import Any

import numpy as np
import xarray as xr

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case import CaseError, read_case_text
from viscontact.drawing.content.design import parameters_of, shown_scalars
from viscontact.drawing.content.look import Look
from viscontact.drawing.matplotlib import trials
from viscontact.drawing.plotly.parts import plain
from viscontact.drawing.plotly.responses import responses
from viscontact.report.design_page import trial_rows
from viscontact.report.study_page import StudyRows
from viscontact.report.sweep_page import (
    messages_of,
    response_caption,
    run_rows,
    sweep_page,
    warnings_of,
    why_not_drawn,
)
from viscontact.results.netcdf import open_results
from viscontact.results.run_files import MANIFEST_NAME
from viscontact.results.variables import SCALARS
from viscontact.studies.space import DIGITS
from viscontact.studies.study_files import TRIALS_NAME, write_rows
from viscontact.studies.sweep.joint_layout import joint_layout
from viscontact.studies.sweep.manifest import read_manifest
from viscontact.studies.sweep.open_many import open_many
from viscontact.studies.sweep.run_table import write_run_table
from viscontact.units.parsing import parse_any_quantity
from viscontact.web.runs.study import StudyRun
from viscontact.web.workspace.pictures import PictureChoice, picture
from viscontact.web.workspace.problems import RequestError, case_problems

#: Report in the directory of a design.
REPORT_NAME = "report.html"

_NO_ANSWER = "no run of this study is finished"


@dataclass(frozen=True)
class Drawn:
    """Figures of a study: interactive ones as Plotly reads them, or drawings as SVG."""

    figures: tuple[Mapping[str, Any], ...] = ()
    drawings: tuple[Mapping[str, str], ...] = ()
    caption: str = ""


def study_answer(run: StudyRun, look: Look, *, dark: bool) -> dict[str, Any]:
    """Return table, figures and notes of a study as plain data."""
    if run.is_sweep:
        with _sweep(run) as ds:
            drawn, notes = _responses(ds, look), [*messages_of(ds), *warnings_of(ds)]
            return {"headline": "", "best": None, **_plain(run_rows(ds), drawn, notes)}
    with _trials(run) as table:
        notes = str(table.attrs.get("notes", "")).splitlines()
        about = {"headline": str(table.attrs["headline"]), "best": int(table.attrs["best"])}
        return about | _plain(trial_rows(table), _drawings(table, dark=dark), notes)


def _plain(rows: StudyRows, drawn: Drawn, notes: list[str]) -> dict[str, Any]:
    table = {"head": list(rows.head), "rows": [list(row) for row in rows.rows]}
    return {
        "table": {**table, "numbers": list(rows.numbers)},
        **{"figures": drawn.figures, "drawings": drawn.drawings, "caption": drawn.caption},
        "notes": notes,
    }


def _responses(ds: xr.Dataset, look: Look) -> Drawn:
    try:
        figures = tuple(plain(each) for each in responses(ds, look))
    except ValueError:  # too few runs, or all alike
        return Drawn(caption=why_not_drawn(ds))
    return Drawn(figures, caption=response_caption(ds))


def _drawings(table: xr.Dataset, *, dark: bool) -> Drawn:
    choice = PictureChoice("trials", is_dark=dark)
    drawings = tuple(
        {
            "caption": f"{SCALARS[name].label} over each parameter",
            "svg": picture(trials(table, scalar=name), choice).decode(),
        }
        for name in shown_scalars(table)
    )
    caption = "Full points: cells of the case; pale: coarse cells; crosses: not feasible."
    return Drawn(drawings=drawings, caption=caption)


def study_table(run: StudyRun) -> str:
    """Return the table of a study as CSV, in SI units with every digit."""
    text = io.StringIO()
    if run.is_sweep:
        with _as_answer():
            write_run_table(joint_layout(run.directory), text, lambda done, total: None)
    else:
        with _trials(run) as table:
            write_rows(table, "trial", text)
    return text.getvalue()


def study_report(run: StudyRun) -> bytes:
    """Return the report of a study, which a design has written."""
    if run.is_sweep:
        with _sweep(run) as ds:
            return sweep_page(ds, title=run.label).encode()
    try:
        return (run.directory / REPORT_NAME).read_bytes()
    except OSError as error:
        raise RequestError(409, "there is no report until the design is done") from error


def case_of_run(run: StudyRun, number: int) -> str:
    """Return the text of the case of a run, by its row in the table."""
    settings = _settings_of(run, number)
    try:
        return read_case_text(run.given.read_text(encoding="utf-8"), run.given, settings).text
    except CaseError as error:
        raise case_problems(error, run.given) from error


def _settings_of(run: StudyRun, number: int) -> list[str]:
    if run.is_sweep:
        with _as_answer():
            runs = list(read_manifest(run.directory / MANIFEST_NAME))
        _require_row(number, len(runs))
        return list(runs[number].assignments)
    with _trials(run) as table:
        _require_row(number, table.sizes["trial"])
        trial = table.isel(trial=number)
        return [f"{key}={_typed(trial[key])}" for key in parameters_of(table)]


def _typed(column: xr.DataArray) -> str:
    """Value of a parameter as it was typed, in the unit that it was typed in."""
    value: Any = column.values[()]
    if not np.issubdtype(column.dtype, np.number):
        return str(value)
    unit = str(column.attrs.get("typed_unit", ""))
    one, two = (parse_any_quantity(f"{number} {unit}")[0] if unit else number for number in (1, 2))
    if two != 2 * one:  # a temperature scale with an origin of its own
        return f"{value:.{DIGITS + 3}g} {column.attrs['units']}"
    return f"{value / one:.{DIGITS}g} {unit}".strip()


def _require_row(number: int, count: int) -> None:
    if not 0 <= number < count:
        raise RequestError(404, f"the study has {count} runs, numbered from 0; got {number}")


@contextmanager
def _sweep(run: StudyRun) -> Iterator[xr.Dataset]:
    with ExitStack() as opened:
        with _as_answer():  # the opening alone: a fault in what is made of it is no damaged file
            ds = opened.enter_context(open_many(run.directory))
        yield ds


@contextmanager
def _trials(run: StudyRun) -> Iterator[xr.Dataset]:
    with ExitStack() as opened:
        with _as_answer():
            table = opened.enter_context(open_results(run.directory / TRIALS_NAME))
        yield table


@contextmanager
def _as_answer() -> Iterator[None]:
    """Turn a study whose files are missing or damaged into a refusal."""
    try:
        yield
    except FileNotFoundError as error:
        raise RequestError(409, _NO_ANSWER) from error
    except (OSError, ValueError) as error:
        raise RequestError(409, f"the files of this study cannot be read: {error}") from error
