"""Requests about cases: examples, materials, checks, drawings, files that they read."""

from __future__ import annotations

import re
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Depends, Query, Request, Response
from pydantic import BaseModel

from viscontact import __version__
from viscontact.case import case_schema
from viscontact.case.yaml_source import parse, rewritten
from viscontact.materials import library
from viscontact.plot import COMPARISONS, FIGURES
from viscontact.plot.layout.page import Width
from viscontact.web.calculator import Calculator
from viscontact.web.cases.case_reader import filled
from viscontact.web.cases.drawings import drawing
from viscontact.web.workspace.naming import suggested_title
from viscontact.web.workspace.pictures import MEDIA_TYPES, Wish, picture
from viscontact.web.workspace.problems import RequestError

router = APIRouter(prefix="/api")

Quality = Literal["coarse", "full"]


def calculator_of(request: Request) -> Calculator:
    """Return what answers a request."""
    found = request.app.state.calculator
    assert isinstance(found, Calculator)
    return found


Ours = Annotated[Calculator, Depends(calculator_of)]


class CaseText(BaseModel):
    """A case as it would stand in a file, and how well it is to be computed."""

    yaml: str
    quality: Quality = "full"


class CaseValues(BaseModel):
    """The values of a case, the text in whose manner they are to be written, and whose title."""

    case: dict[str, Any]
    yaml: str = ""
    titled: bool = True


class DrawingWish(BaseModel):
    """A case, and what of it is to be drawn."""

    yaml: str
    what: Literal["indenter", "material", "indenter_material", "load"]
    dark: bool = False
    narrow: bool = False


@router.get("/version")
async def version(ours: Ours) -> dict[str, Any]:
    """Tell which version this is, where it keeps things, and what it can draw."""
    return {
        "version": __version__,
        "data": str(ours.folder.path),
        "at_once": ours.workshop.at_once,
        "figures": list(FIGURES),
        "comparisons": list(COMPARISONS),
    }


@router.get("/schema")
def schema() -> dict[str, Any]:
    """Tell what a case file may hold."""
    return case_schema()


@router.get("/examples")
def examples() -> list[dict[str, Any]]:
    """Tell the shipped cases."""
    return _examples()


@cache
def _examples() -> list[dict[str, Any]]:
    shipped = {Path(entry.name): entry for entry in files("viscontact.examples").iterdir()}
    texts = {
        path.stem: shipped[path].read_text(encoding="utf-8")
        for path in sorted(shipped)
        if path.suffix == ".yaml"
    }
    return [
        {"name": name, "title": _title(text), "yaml": text, "case": parse(text)[0]}
        for name, text in texts.items()
    ]


@router.get("/materials")
def shipped_materials() -> list[dict[str, str]]:
    """Tell the materials of the library."""
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
def as_yaml(asked: CaseValues) -> dict[str, str]:
    """Write values as a case file; one that is not titled gets a title that tells what it is."""
    try:
        values = filled(asked.case)
        title = suggested_title(values)
        if not asked.titled:
            # Where there was none, it stands first.
            values = filled({"title": title} | values | {"title": title})
        return {"yaml": rewritten(asked.yaml, values), "suggested_title": title}
    except RecursionError as error:
        raise RequestError(422, "nested too deeply for a case file") from error


@router.post("/case")
def as_values(asked: CaseText, ours: Ours) -> dict[str, Any]:
    """Tell the values of a case file."""
    values = ours.desk.values(asked.yaml)
    return {"case": values, "suggested_title": suggested_title(values)}


@router.post("/check")
async def check(asked: CaseText, ours: Ours, request: Request) -> dict[str, Any]:
    """Check a case."""
    return await ours.do(lambda: ours.desk.check(asked.yaml, asked.quality), request)


@router.post("/drawing")
async def draw(asked: DrawingWish, ours: Ours, request: Request) -> Response:
    """Draw a part of a case."""
    wish = Wish(asked.what, is_dark=asked.dark)
    width: Width | None = "single" if asked.narrow else None
    drawn = await ours.do(
        lambda: picture(drawing(ours.desk, asked.yaml, asked.what, width), wish), request
    )
    return Response(drawn, media_type=MEDIA_TYPES["svg"])


@router.get("/files")
def known_files(ours: Ours) -> list[dict[str, Any]]:
    """Tell which files cases may read."""
    return ours.folder.files()


@router.post("/files", status_code=201)
async def put_file(
    ours: Ours, request: Request, name: Annotated[str, Query(max_length=200)]
) -> dict[str, Any]:
    """Keep a file for cases to read."""
    content = await request.body()
    await ours.do(lambda: ours.folder.put_file(name, content))
    return {"name": name, "size": len(content)}


@router.delete("/files/{name}", status_code=204)
def remove_file(ours: Ours, name: str) -> None:
    """Remove a file."""
    ours.folder.remove_file(name)


def _title(text: str) -> str:
    found = re.search(r"^title: *(.*)$", text, re.MULTILINE)
    return found[1] if found else ""
