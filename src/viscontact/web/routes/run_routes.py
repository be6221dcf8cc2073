"""Routes about runs: start, follow, stop, resume and delete; figures and files."""

from __future__ import annotations

import asyncio
import io
import json
from contextlib import ExitStack, suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated, Any
from urllib.parse import quote

from fastapi import APIRouter, Depends, Query, Request, Response
from fastapi.responses import FileResponse, StreamingResponse

from viscontact.drawing.matplotlib import COMPARISONS, FIGURES, STEADY_FIGURES
from viscontact.report import write_report
from viscontact.report.run_data import run_data
from viscontact.results.history_csv import write_history
from viscontact.results.run_files import CASE_NAME, RESULT_NAME
from viscontact.units.systems import AUTOMATIC
from viscontact.web.cases.case_reader import CaseReader
from viscontact.web.guard import REPORT_POLICY
from viscontact.web.routes.case_routes import AppCalculator, CaseText
from viscontact.web.runs.live_scalars import grown
from viscontact.web.runs.run import ManagedRun
from viscontact.web.runs.run_figures import look_of, run_figures
from viscontact.web.workspace.naming import file_stem
from viscontact.web.workspace.pictures import (
    MEDIA_TYPES,
    Kind,
    PictureChoice,
    comparison_of,
    figure_of,
    result_in,
)
from viscontact.web.workspace.problems import RequestError

router = APIRouter(prefix="/api")

Place = Annotated[int, Query(ge=0, le=2**53)]
Times = Annotated[list[str] | None, Query(alias="time", max_length=12)]
Speeds = Annotated[list[str] | None, Query(alias="speed", max_length=12)]


async def _picture_choice(
    kind: Kind, figure: str = "history", time: Times = None, speed: Speeds = None,
    dark: bool = False,
) -> PictureChoice:  # fmt: skip
    """Read the choice of a figure from a request."""
    return PictureChoice(figure, tuple(time or ()), tuple(speed or ()), kind=kind, is_dark=dark)


Choice = Annotated[PictureChoice, Depends(_picture_choice)]

_NO_CASE = "the case of this run is no longer in the folder; delete the run here"
#: Time that an answer about a run waits for the summary of its result [s].
_PATIENCE = 0.5
#: Largest number of runs in one figure.
_MOST_COMPARED = 8


@router.get("/runs")
async def runs(calculator: AppCalculator) -> list[dict[str, Any]]:
    """Return the status of all runs."""
    found = [calculator.status(run, _PATIENCE) for run in calculator.queue.runs]
    return await asyncio.gather(*found)


@router.post("/runs", status_code=201)
async def begin(body: CaseText, calculator: AppCalculator, request: Request) -> dict[str, Any]:
    """Check a case, and add it to the queue."""
    if calculator.queue.is_closing:
        raise RequestError(503, "the server is about to end")
    others = [(run.name, run.entry) for run in reversed(calculator.queue.runs)]
    with calculator.queue.place():
        new = await calculator.about_case(
            request, CaseReader.new_run, body.yaml, body.quality, others
        )
        run = calculator.queue.add(*new)
    return await calculator.status(run, _PATIENCE)


@router.get("/runs/{name}")
async def status(calculator: AppCalculator, name: str) -> dict[str, Any]:
    """Return the status of a run."""
    return await calculator.status(calculator.queue.run(name), _PATIENCE)


@router.delete("/runs/{name}", status_code=204)
async def delete(calculator: AppCalculator, name: str) -> None:
    """Delete a run and its files."""
    calculator.queue.delete(calculator.queue.run(name))


@router.post("/runs/{name}/cancel")
async def cancel(calculator: AppCalculator, name: str) -> dict[str, Any]:
    """Stop a run after its current step; its results are kept."""
    run = calculator.queue.run(name)
    calculator.queue.cancel(run)
    return await calculator.status(run, _PATIENCE)


@router.post("/runs/{name}/resume")
async def resume(calculator: AppCalculator, name: str) -> dict[str, Any]:
    """Continue a run that stopped early."""
    run = calculator.queue.run(name)
    calculator.queue.resume(run)
    return await calculator.status(run, _PATIENCE)


@router.get("/runs/{name}/events")
async def events(calculator: AppCalculator, name: str) -> StreamingResponse:
    """Stream the status of a run until it is over."""
    stream = calculator.events(calculator.queue.run(name))
    return StreamingResponse(stream, media_type="text/event-stream")


@router.get("/runs/{name}/grown")
def growth(calculator: AppCalculator, name: str, after: Place = 0) -> dict[str, Any]:
    """Return the scalars that a run has written after a position in its log."""
    return grown(calculator.queue.run(name).directory, after)


@router.get("/runs/{name}/growing")
def growing(
    calculator: AppCalculator, name: str, dark: bool = False, units: str = AUTOMATIC
) -> Response:
    """Return figures of the scalars of an active run, as far as they are computed."""
    run, look = calculator.queue.run(name), look_of(units, dark=dark)
    ends = (run.entry.begin or 0.0, run.entry.end)
    found = run.live.drawn(run.axis, ends, look)
    return Response(json.dumps(found, allow_nan=False), media_type="application/json")


@router.get("/runs/{name}/given")
def given(calculator: AppCalculator, name: str) -> dict[str, str]:
    """Return the case of a run as submitted."""
    run = calculator.queue.run(name)
    try:
        text = run.given.read_text(encoding="utf-8")
    except (OSError, ValueError) as error:
        raise RequestError(409, _NO_CASE) from error
    return {"yaml": text, "quality": run.entry.quality}


@router.get("/runs/{name}/data")
async def data(calculator: AppCalculator, name: str, request: Request) -> dict[str, Any]:
    """Return the numbers of a run."""
    run = calculator.queue.run(name)

    def read() -> dict[str, Any]:
        with result_in(run.directory) as ds:
            return run_data(ds)

    return await calculator.do(read, request)


@router.get("/runs/{name}/figures")
async def interactive(
    calculator: AppCalculator, name: str, request: Request,
    reference: str | None = None, dark: bool = False, units: str = AUTOMATIC,
) -> Response:  # fmt: skip
    """Return the interactive figures of a run, beside those of a reference."""
    run, look = calculator.queue.run(name), look_of(units, dark=dark)
    other = None if reference is None else calculator.queue.run(reference)

    def write() -> str:
        with ExitStack() as stack:
            ds = stack.enter_context(result_in(run.directory))
            beside = None if other is None else stack.enter_context(result_in(other.directory))
            return json.dumps(run_figures(ds, look, beside), allow_nan=False)

    return Response(await calculator.do(write, request), media_type="application/json")


@router.get("/runs/{name}/figure/{figure}.{kind}")
async def draw(calculator: AppCalculator, name: str, choice: Choice, request: Request) -> Response:
    """Draw a figure of a run."""
    run = calculator.queue.run(name)
    figures = FIGURES | STEADY_FIGURES
    drawn = await calculator.do(lambda: figure_of(run.directory, figures, choice), request)
    return Response(drawn, media_type=MEDIA_TYPES[choice.kind])


@router.get("/compare.{kind}")
async def compare(
    calculator: AppCalculator, runs: str, choice: Choice, request: Request
) -> Response:
    """Draw a figure of several runs."""
    compared = [calculator.queue.run(name) for name in dict.fromkeys(runs.split(","))]
    if not 2 <= len(compared) <= _MOST_COMPARED:
        raise RequestError(
            422, f"two to {_MOST_COMPARED} runs can be compared, got {len(compared)}"
        )
    places = dict(zip(_labels(compared), (run.directory for run in compared), strict=True))
    drawn = await calculator.do(lambda: comparison_of(places, COMPARISONS, choice), request)
    return Response(drawn, media_type=MEDIA_TYPES[choice.kind])


@router.get("/runs/{name}/case.yaml")
def case_file(calculator: AppCalculator, name: str) -> FileResponse:
    """Download the case as it is run."""
    run = calculator.queue.run(name)
    as_run = run.directory / CASE_NAME
    path = as_run if as_run.is_file() else run.given
    if not path.is_file():
        raise RequestError(409, _NO_CASE)
    return FileResponse(path, filename=f"{_stem(run)}.yaml", media_type="application/yaml")


@router.get("/runs/{name}/result.nc")
def result(calculator: AppCalculator, name: str) -> FileResponse:
    """Download the result of a run that is over."""
    run = calculator.queue.run(name)
    path = run.directory / RESULT_NAME
    if not run.is_over:
        raise RequestError(409, "the run is still active; its result is available once it is over")
    if not path.is_file():
        raise RequestError(409, "the run has no result: it stopped before its first step")
    return FileResponse(path, filename=f"{_stem(run)}.nc", media_type="application/x-netcdf")


@router.get("/runs/{name}/history.csv")
async def history(calculator: AppCalculator, name: str, request: Request) -> Response:
    """Download all scalars over time or speed."""
    run = calculator.queue.run(name)

    def write() -> str:
        text = io.StringIO()
        with result_in(run.directory) as ds:
            write_history(ds, text)
        return text.getvalue()

    return download(await calculator.do(write, request), f"{_stem(run)}.csv", "text/csv")


@router.get("/runs/{name}/report.html")
async def report(
    calculator: AppCalculator, name: str, request: Request, view: bool = False
) -> Response:
    """Download the report of a run, or show it."""
    run = calculator.queue.run(name)
    page = await calculator.do(lambda: _report(run, calculator), request)
    if view:
        headers = {"content-security-policy": REPORT_POLICY}
        return Response(page, media_type="text/html", headers=headers)
    return download(page, f"{_stem(run)}.html", "text/html")


def _report(run: ManagedRun, calculator: AppCalculator) -> bytes:
    """Report of a run, written again if the result has changed since."""
    kept, made_from = calculator.folder.report(run.name), run.directory / RESULT_NAME
    with result_in(run.directory) as ds, TemporaryDirectory() as elsewhere:
        # The times must be equal; "later" would fail after a clock is set back.
        written = made_from.stat().st_mtime_ns
        if kept.is_file() and kept.stat().st_mtime_ns == written:
            return kept.read_bytes()
        fresh = Path(elsewhere) / kept.name
        try:
            write_report(ds, fresh, label=_label(run))
        except (ValueError, OSError) as error:
            raise RequestError(422, f"there is no report: {error}") from error
        page = fresh.read_bytes()
    with suppress(OSError):  # a full disk; the report is written again at the next request
        calculator.folder.keep_report(run.name, page, written)
    return page


def _labels(compared: list[ManagedRun]) -> list[str]:
    """Labels of runs in a figure, numbered where they are equal."""
    labels = [_label(run) for run in compared]
    if len(set(labels)) == len(labels):
        return labels
    return [f"{number}: {label}" for number, label in enumerate(labels, start=1)]


def _label(run: ManagedRun) -> str:
    return f"{run.label} (coarse)" if run.entry.quality == "coarse" else run.label


def _stem(run: ManagedRun) -> str:
    return file_stem(run.label, run.entry.quality)


def download(content: str | bytes, name: str, media_type: str) -> Response:
    """Return content as a file to be saved."""
    headers = {"content-disposition": f"attachment; filename*=utf-8''{quote(name)}"}
    return Response(content, media_type=media_type, headers=headers)
