"""Routes about studies of a case: start, answer, files, and the case of a run."""

from __future__ import annotations

import json
from typing import Any

from fastapi import APIRouter, Request, Response

from viscontact.results.variables import (
    OF_LEAKAGE,
    OF_LEAKAGE_Y,
    SCALARS,
    Place,
    scalars_with_error,
    shown_in,
)
from viscontact.units.systems import AUTOMATIC
from viscontact.web.cases.study_requests import StudyRequest, new_study
from viscontact.web.guard import REPORT_POLICY
from viscontact.web.routes.case_routes import AppCalculator
from viscontact.web.routes.run_routes import download
from viscontact.web.runs.run_figures import look_of
from viscontact.web.runs.study import StudyRun
from viscontact.web.runs.study_answers import (
    case_of_run,
    study_answer,
    study_report,
    study_table,
)
from viscontact.web.workspace.naming import file_stem
from viscontact.web.workspace.problems import RequestError

router = APIRouter(prefix="/api")


@router.get("/scalars")
def scalars() -> list[dict[str, Any]]:
    """Return the scalars that a design makes least or largest, or bounds; the chief ones first."""
    names, chief = [*scalars_with_error(), *OF_LEAKAGE, *OF_LEAKAGE_Y], shown_in(Place.KEY)
    return [
        {"name": name, "label": SCALARS[name].label, "chief": name in chief}
        for name in sorted(names, key=lambda each: each not in chief)
    ]


@router.post("/studies", status_code=201)
async def begin(body: StudyRequest, calculator: AppCalculator, request: Request) -> dict[str, Any]:
    """Check a study, and add it to the queue."""
    queue = calculator.queue
    if queue.is_closing:
        raise RequestError(503, "the server is about to end")
    taken = [run.label for run in queue.runs if isinstance(run, StudyRun)]
    with queue.place():
        new = await calculator.about_case(request, new_study, body, queue.at_once, taken)
        run = queue.add(*new)
    return await calculator.status(run)


@router.get("/studies/{name}")
async def answer(
    calculator: AppCalculator, name: str, request: Request,
    dark: bool = False, units: str = AUTOMATIC,
) -> Response:  # fmt: skip
    """Return table, figures and notes of a study, as far as its runs are finished."""
    run, look = _study(calculator, name), look_of(units, dark=dark)

    def write() -> str:
        return json.dumps(study_answer(run, look, dark=dark), allow_nan=False)

    return Response(await calculator.do(write, request), media_type="application/json")


@router.get("/studies/{name}/table.csv")
async def table(calculator: AppCalculator, name: str, request: Request) -> Response:
    """Download the table of a study in SI units."""
    run = _study(calculator, name)
    text = await calculator.do(lambda: study_table(run), request)
    return download(text, f"{_stem(run)}.csv", "text/csv")


@router.get("/studies/{name}/report.html")
async def report(
    calculator: AppCalculator, name: str, request: Request, view: bool = False
) -> Response:
    """Download the report of a study, or show it."""
    run = _study(calculator, name)
    page = await calculator.do(lambda: study_report(run), request)
    if view:
        headers = {"content-security-policy": REPORT_POLICY}
        return Response(page, media_type="text/html", headers=headers)
    return download(page, f"{_stem(run)}.html", "text/html")


@router.get("/studies/{name}/runs/{number}/given")
async def case(
    calculator: AppCalculator, name: str, number: int, request: Request
) -> dict[str, str]:
    """Return the case of a run of a study, by its row in the table."""
    run = _study(calculator, name)
    return {"yaml": await calculator.do(lambda: case_of_run(run, number), request)}


def _study(calculator: AppCalculator, name: str) -> StudyRun:
    run = calculator.queue.run(name)
    if not isinstance(run, StudyRun):
        raise RequestError(404, f"{name[:40]!r} is a single run, and no study")
    return run


def _stem(run: StudyRun) -> str:
    return file_stem(run.label, run.entry.quality)
