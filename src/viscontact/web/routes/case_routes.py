"""Routes about cases: examples, materials, checks, drawings and files."""

from __future__ import annotations

import json
import re
from dataclasses import asdict
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Depends, Query, Request, Response
from fastapi.concurrency import run_in_threadpool
from pydantic import BaseModel

from viscontact import __version__
from viscontact.bodies.materials import library
from viscontact.case import case_schema
from viscontact.case.yaml_source import rewritten
from viscontact.drawing.figures import compared_names, names_of
from viscontact.drawing.matplotlib.layout.page import Width
from viscontact.results.run_axis import SPEED, TIME
from viscontact.results.variables import SCALARS
from viscontact.units.formatting import unit_ladder
from viscontact.units.systems import AUTOMATIC, SYSTEM_NAMES, SYSTEMS
from viscontact.web.calculator import Calculator
from viscontact.web.cases.adhesion_fits import AdhesionFitRequest, adhesion_of_upload
from viscontact.web.cases.case_reader import CaseReader, filled, form_values
from viscontact.web.cases.curve_fits import CurveFitRequest, fit_of_upload
from viscontact.web.cases.drawings import drawn_as_svg
from viscontact.web.cases.file_contents import contents_of_upload
from viscontact.web.cases.material_fits import MaterialFitRequest, fitted_tests
from viscontact.web.runs.run_figures import look_of
from viscontact.web.workspace.naming import suggested_title
from viscontact.web.workspace.pictures import PictureChoice
from viscontact.web.workspace.problems import RequestError

router = APIRouter(prefix="/api")

Quality = Literal["coarse", "full"]


def calculator_of(request: Request) -> Calculator:
    """Return the calculator of a request."""
    found = request.app.state.calculator
    assert isinstance(found, Calculator)
    return found


AppCalculator = Annotated[Calculator, Depends(calculator_of)]


class CaseText(BaseModel):
    """Text of a case file, and the quality of its run."""

    yaml: str
    quality: Quality = "full"


class CaseValues(BaseModel):
    """Values of a case, and the text whose layout is kept when they are written."""

    case: dict[str, Any]
    yaml: str = ""
    titled: bool = True  # without it, a title is derived from the values


class DrawingRequest(BaseModel):
    """Case and the part of it to draw."""

    yaml: str
    what: Literal["indenter", "material", "indenter_material", "load"]
    dark: bool = False
    narrow: bool = False


@router.get("/version")
async def version(calculator: AppCalculator) -> dict[str, Any]:
    """Return the version, the data folder and the available figures."""
    return {
        "version": __version__,
        "data": str(calculator.folder.path),
        "at_once": calculator.queue.at_once,
        "figures": names_of("time", "both", "speed"),
        "comparisons": compared_names(),
    }


@router.get("/schema")
def schema() -> dict[str, Any]:
    """Return the JSON schema of case files."""
    return case_schema()


@router.get("/units")
def unit_table() -> dict[str, Any]:
    """Return the systems of units, and the units of each SI unit of a result, by least size."""
    fixed = {
        system: {si: asdict(unit) for si, unit in found.items()}
        for system, found in SYSTEMS.items()
    }
    quantities = {*(each.units for each in SCALARS.values()), TIME.unit, SPEED.unit}
    return {
        "systems": {name: {"name": SYSTEM_NAMES[name], "units": fixed[name]} for name in SYSTEMS},
        "ladders": {
            si: [asdict(unit) | {"least": least} for unit, least in unit_ladder(si)]
            for si in sorted(quantities)
        },
    }


@router.get("/examples")
def examples() -> list[dict[str, Any]]:
    """Return the shipped cases."""
    return _examples()


@cache
def _examples() -> list[dict[str, Any]]:
    shipped = {Path(entry.name): entry for entry in files("viscontact.case.examples").iterdir()}
    texts = {
        path.stem: shipped[path].read_text(encoding="utf-8")
        for path in sorted(shipped)
        if path.suffix == ".yaml"
    }
    return [
        {"name": name, "title": _title(text), "yaml": text, "case": form_values(text, Path(name))}
        for name, text in texts.items()
    ]


@router.get("/materials")
def shipped_materials() -> list[dict[str, str]]:
    """Return the materials of the library."""
    entries = (library.entry(name) for name in library.names())
    return [
        {
            "name": entry.name,
            "title": entry.title,
            "temperature": entry.temperature,
            "source": entry.cite,
        }
        for entry in entries
    ]


@router.post("/yaml")
def as_yaml(body: CaseValues) -> dict[str, str]:
    """Return values as the text of a case file, with a suggested title if it has none."""
    try:
        values = filled(body.case)
        title = suggested_title(values)
        if not body.titled:
            # A new title is the first key.
            values = filled({"title": title} | values | {"title": title})
        return {"yaml": rewritten(body.yaml, values), "suggested_title": title}
    except RecursionError as error:
        raise RequestError(422, "nested too deeply for a case file") from error


@router.post("/case")
def as_values(body: CaseText, calculator: AppCalculator) -> dict[str, Any]:
    """Return the values of a case file."""
    values = calculator.cases.values(body.yaml)
    return {"case": values, "suggested_title": suggested_title(values)}


@router.post("/check")
async def check(body: CaseText, calculator: AppCalculator, request: Request) -> dict[str, Any]:
    """Check a case."""
    return await calculator.about_case(request, CaseReader.check, body.yaml, body.quality)


@router.post("/drawing")
async def draw(
    body: DrawingRequest, calculator: AppCalculator, request: Request
) -> list[dict[str, str]]:
    """Draw a part of a case: figures as SVG, empty where there is a caption only."""
    choice = PictureChoice(body.what, is_dark=body.dark)
    width: Width | None = "single" if body.narrow else None
    return await calculator.about_case(request, drawn_as_svg, body.yaml, choice, width)


@router.post("/fit")
async def fit(
    body: CurveFitRequest, calculator: AppCalculator, request: Request,
    dark: bool = False, units: str = AUTOMATIC,
) -> Response:  # fmt: skip
    """Fit a law to an uploaded force curve or indentation record."""
    look = look_of(units, dark=dark)
    found = await calculator.about_case(request, fit_of_upload, body, look)
    return Response(json.dumps(found, allow_nan=False), media_type="application/json")


@router.post("/fit/material")
async def fit_material(
    body: MaterialFitRequest, calculator: AppCalculator, request: Request,
    dark: bool = False, narrow: bool = False,
) -> dict[str, Any]:  # fmt: skip
    """Fit a law to uploaded tests of a material, at one temperature or at several."""
    width: Width | None = "single" if narrow else None
    return await calculator.about_case(request, fitted_tests, body, dark=dark, width=width)


@router.post("/fit/adhesion")
async def fit_adhesion(
    body: AdhesionFitRequest, calculator: AppCalculator, request: Request,
    dark: bool = False, narrow: bool = False,
) -> dict[str, Any]:  # fmt: skip
    """Fit adhesion to an uploaded force curve of a sphere."""
    width: Width | None = "single" if narrow else None
    return await calculator.about_case(request, adhesion_of_upload, body, dark=dark, width=width)


@router.get("/files")
def known_files(calculator: AppCalculator) -> list[dict[str, Any]]:
    """Return the files that cases may read."""
    return calculator.folder.files()


@router.post("/files", status_code=201)
async def put_file(
    calculator: AppCalculator, request: Request, name: Annotated[str, Query(max_length=200)]
) -> dict[str, Any]:
    """Store a file for cases to read."""
    with calculator.folder.receiving(name) as upload:
        async for part in request.stream():
            upload.write(part)
        await run_in_threadpool(upload.keep)
    return {"name": name, "size": upload.size}


@router.get("/files/{name}/contents")
async def contents(calculator: AppCalculator, request: Request, name: str) -> dict[str, Any]:
    """Tell what a file holds, and the section of a case that names it."""
    return await calculator.about_case(request, contents_of_upload, name)


@router.delete("/files/{name}", status_code=204)
def remove_file(calculator: AppCalculator, name: str) -> None:
    """Remove a file."""
    calculator.folder.remove_file(name)


def _title(text: str) -> str:
    found = re.search(r"^title: *(.*)$", text, re.MULTILINE)
    return found[1] if found else ""
