"""A client of the calculator page, and the numbers of results to the last bit."""

from __future__ import annotations

import io
from collections.abc import Iterator
from pathlib import Path

import pytest
import xarray as xr
from fastapi.testclient import TestClient

from viscontact.cli import main
from web.calculator_page import asking


@pytest.fixture
def client(tmp_path: Path) -> Iterator[TestClient]:
    with asking(tmp_path / "page") as client:
        yield client


def numbers(result: Path | bytes) -> dict[str, bytes]:
    """Return all numbers of a result to the last bit."""
    with xr.open_dataset(io.BytesIO(result) if isinstance(result, bytes) else result) as ds:
        return {str(name): ds[name].values.tobytes() for name in ds.variables}


def by_command_line(text: str, folder: Path) -> Path:
    """Run a case as anybody could type it, and return its result."""
    case = folder / "typed.yaml"
    case.write_text(text, encoding="utf-8")
    assert main(["run", str(case), "-q"]) == 0
    return folder / "typed" / "result.nc"
