"""Requests about runs: begin, follow, stop, resume, forget; their figures and files."""

from __future__ import annotations

import io
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated, Any
from urllib.parse import quote

from fastapi import APIRouter, Query, Request, Response
from fastapi.responses import FileResponse, StreamingResponse

from viscontact.plot import COMPARISONS, FIGURES
from viscontact.report import write_report
from viscontact.report.run_data import run_data
from viscontact.results.history_csv import write_history
from viscontact.run_files import CASE_NAME, RESULT_NAME
from viscontact.web.guard import REPORT_POLICY
from viscontact.web.routes.case_routes import CaseText, Ours
from viscontact.web.runs.live_scalars import grown
from viscontact.web.runs.run import Work
from viscontact.web.workspace.naming import file_stem
from viscontact.web.workspace.pictures import (
    MEDIA_TYPES,
    Kind,
    Wish,
    comparison_of,
    figure_of,
    opened,
)
from viscontact.web.workspace.problems import RequestError

router = APIRouter(prefix="/api")

Place = Annotated[int, Query(ge=0, le=2**53)]
Times = Annotated[list[str] | None, Query(alias="time", max_length=12)]

_NO_CASE = "the case of this run is gone from the folder; delete the run here"
#: More runs than this are not told apart in one figure.
_MOST_COMPARED = 8


@router.get("/runs")
async def runs(ours: Ours) -> list[dict[str, Any]]:
    """Tell how all runs stand."""
    return [await ours.status(work) for work in ours.workshop.works]


@router.post("/runs", status_code=201)
async def begin(asked: CaseText, ours: Ours, request: Request) -> dict[str, Any]:
    """Check a case, and let it wait for its turn to be run."""
    if ours.workshop.is_closing:
        raise RequestError(503, "the server is about to end")
    others = [(work.name, work.asked) for work in reversed(ours.workshop.works)]
    new = await ours.do(lambda: ours.desk.new_run(asked.yaml, asked.quality, others), request)
    return await ours.status(ours.workshop.ask(*new))


@router.get("/runs/{name}")
async def status(ours: Ours, name: str) -> dict[str, Any]:
    """Tell how a run stands."""
    return await ours.status(ours.workshop.work(name))


@router.delete("/runs/{name}", status_code=204)
async def forget(ours: Ours, name: str) -> None:
    """Remove a run and all that is kept of it."""
    ours.workshop.forget(ours.workshop.work(name))


@router.post("/runs/{name}/cancel")
async def cancel(ours: Ours, name: str) -> dict[str, Any]:
    """Stop a run after its step; what it has done is kept."""
    work = ours.workshop.work(name)
    ours.workshop.cancel(work)
    return await ours.status(work)


@router.post("/runs/{name}/resume")
async def resume(ours: Ours, name: str) -> dict[str, Any]:
    """Go on with a run that stopped early."""
    work = ours.workshop.work(name)
    ours.workshop.resume(work)
    return await ours.status(work)


@router.get("/runs/{name}/events")
async def events(ours: Ours, name: str) -> StreamingResponse:
    """Tell how a run stands, until it is over."""
    told = ours.events(ours.workshop.work(name))
    return StreamingResponse(told, media_type="text/event-stream")


@router.get("/runs/{name}/grown")
def growth(ours: Ours, name: str, after: Place = 0) -> dict[str, Any]:
    """Tell the scalars that a run has written since it was last asked."""
    return grown(ours.workshop.work(name).directory, after)


@router.get("/runs/{name}/given")
def given(ours: Ours, name: str) -> dict[str, str]:
    """Tell the case of a run as it was sent."""
    work = ours.workshop.work(name)
    try:
        text = work.given.read_text(encoding="utf-8")
    except (OSError, ValueError) as error:
        raise RequestError(409, _NO_CASE) from error
    return {"yaml": text, "quality": work.asked.quality}


@router.get("/runs/{name}/data")
async def data(ours: Ours, name: str, request: Request) -> dict[str, Any]:
    """Tell the numbers of a run that figures are drawn from."""
    work = ours.workshop.work(name)

    def told() -> dict[str, Any]:
        with opened(work.directory) as ds:
            return run_data(ds)

    return await ours.do(told, request)


@router.get("/runs/{name}/figure/{figure}.{kind}")
async def draw(
    ours: Ours, name: str, figure: str, kind: Kind, request: Request,
    time: Times = None, dark: bool = False,
) -> Response:  # fmt: skip
    """Draw a figure of a run."""
    work = ours.workshop.work(name)
    wish = Wish(figure, kind, tuple(time or ()), dark)
    drawn = await ours.do(lambda: figure_of(work.directory, FIGURES, wish), request)
    return Response(drawn, media_type=MEDIA_TYPES[kind])


@router.get("/compare.{kind}")
async def compare(
    ours: Ours, kind: Kind, runs: str, request: Request,
    figure: str = "history", time: Times = None, dark: bool = False,
) -> Response:  # fmt: skip
    """Draw a figure of several runs."""
    works = [ours.workshop.work(name) for name in dict.fromkeys(runs.split(","))]
    if not 2 <= len(works) <= _MOST_COMPARED:
        raise RequestError(422, f"two to {_MOST_COMPARED} runs can be compared, got {len(works)}")
    places = dict(zip(_labels(works), (work.directory for work in works), strict=True))
    wish = Wish(figure, kind, tuple(time or ()), dark)
    drawn = await ours.do(lambda: comparison_of(places, COMPARISONS, wish), request)
    return Response(drawn, media_type=MEDIA_TYPES[kind])


@router.get("/runs/{name}/case.yaml")
def case_file(ours: Ours, name: str) -> FileResponse:
    """Hand out the case as it is run."""
    work = ours.workshop.work(name)
    as_run = work.directory / CASE_NAME
    path = as_run if as_run.is_file() else work.given
    if not path.is_file():
        raise RequestError(409, _NO_CASE)
    return FileResponse(path, filename=f"{_stem(work)}.yaml", media_type="application/yaml")


@router.get("/runs/{name}/result.nc")
def result(ours: Ours, name: str) -> FileResponse:
    """Hand out the result of a run that is over."""
    work = ours.workshop.work(name)
    path = work.directory / RESULT_NAME
    if not work.is_over:
        raise RequestError(409, "the run is still at work; its result can be had once it is over")
    if not path.is_file():
        raise RequestError(409, "the run has no result: it stopped before its first step")
    return FileResponse(path, filename=f"{_stem(work)}.nc", media_type="application/x-netcdf")


@router.get("/runs/{name}/history.csv")
async def history(ours: Ours, name: str, request: Request) -> Response:
    """Hand out all scalars over time."""
    work = ours.workshop.work(name)

    def told() -> str:
        text = io.StringIO()
        with opened(work.directory) as ds:
            write_history(ds, text)
        return text.getvalue()

    return _download(await ours.do(told, request), f"{_stem(work)}.csv", "text/csv")


@router.get("/runs/{name}/report.html")
async def report(ours: Ours, name: str, request: Request, view: bool = False) -> Response:
    """Hand out the report of a run, or show it."""
    work = ours.workshop.work(name)
    page = await ours.do(lambda: _report(work, ours), request)
    if view:
        headers = {"content-security-policy": REPORT_POLICY}
        return Response(page, media_type="text/html", headers=headers)
    return _download(page, f"{_stem(work)}.html", "text/html")


def _report(work: Work, ours: Ours) -> bytes:
    """The report, written anew if the run has gone on since it was written."""
    kept, made_from = ours.folder.report(work.name), work.directory / RESULT_NAME
    with opened(work.directory) as ds, TemporaryDirectory() as elsewhere:
        # The same time and not a later one: clocks are set back.
        written = made_from.stat().st_mtime_ns
        if kept.is_file() and kept.stat().st_mtime_ns == written:
            return kept.read_bytes()
        fresh = Path(elsewhere) / kept.name
        try:
            write_report(ds, fresh, label=_label(work))
        except (ValueError, OSError) as error:
            raise RequestError(422, f"there is no report: {error}") from error
        page = fresh.read_bytes()
    with suppress(OSError):  # a full disk; the report is made again when it is asked for again
        ours.folder.keep_report(work.name, page, written)
    return page


def _labels(works: list[Work]) -> list[str]:
    """What runs are called in a figure: their labels, numbered where they are alike."""
    # Between two of these a figure would read a formula.
    told = [_label(work).replace("$", r"\$") for work in works]
    if len(set(told)) == len(told):
        return told
    return [f"{number}: {label}" for number, label in enumerate(told, start=1)]


def _label(work: Work) -> str:
    return f"{work.label} (coarse)" if work.asked.quality == "coarse" else work.label


def _stem(work: Work) -> str:
    return file_stem(work.label, work.asked.quality)


def _download(content: str | bytes, name: str, media_type: str) -> Response:
    headers = {"content-disposition": f"attachment; filename*=utf-8''{quote(name)}"}
    return Response(content, media_type=media_type, headers=headers)
