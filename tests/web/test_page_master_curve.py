"""Fit of tests of a material on the calculator page: the answers, and the panel in a browser."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fastapi.testclient import TestClient

import viscontact as vc
import web.served_page as seen
from closeness import close_to
from viscontact.case import read_case_text
from viscontact.cli import main
from web.calculator_page import CASE, asking

WLF = vc.WLF(293.15, 8.86, 101.6)
MODULI, TIMES, REST = (1e6, 3e5, 2e5, 1e5), (1e-3, 0.1, 10.0, 1e3), 5e4


def swept(celsius: tuple[float, ...] = (0.0, 10.0, 20.0, 30.0, 40.0)) -> bytes:
    """Oscillation of a Prony series with shift factors by WLF, without noise."""
    omega = np.geomspace(0.1, 100, 13)
    lines = ["omega [rad/s], temperature [degC], G' [Pa], G'' [Pa]"]
    for each in celsius:
        reduced = 1j * omega * float(WLF.factor(each + 273.15))
        complex_modulus = REST + sum(
            g * reduced * t / (1 + reduced * t) for g, t in zip(MODULI, TIMES, strict=True)
        )
        rows = zip(omega, complex_modulus, strict=True)
        lines += [f"{w!r}, {each}, {z.real!r}, {z.imag!r}" for w, z in rows]
    return "\n".join(line.replace("np.float64(", "").replace(")", "") for line in lines).encode()


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    with asking(tmp_path_factory.mktemp("page")) as client:
        for name, content in {"dma.csv": swept(), "one.csv": swept((20.0,))}.items():
            assert client.post(f"/api/files?name={name}", content=content).status_code == 201
        yield client


def fitted(client: TestClient, **requested: str) -> dict[str, Any]:
    answer = client.post("/api/fit/material", json={"file": "dma.csv", **requested})
    assert answer.status_code == 200, answer.text
    found: dict[str, Any] = answer.json()
    return found


def test_sets_at_several_temperatures_give_shift_factors_and_the_law(
    client: TestClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    found = fitted(client, poisson_ratio="0.5")
    shifts = found["shifts"]
    assert shifts["title"].startswith("5 sets, shifted to 20 °C")
    for celsius, decades in ((row[0], row[1]) for row in shifts["rows"]):
        exact = np.log10(float(WLF.factor(float(celsius) + 273.15)))
        assert float(decades.split(" ± ")[0]) == close_to(exact, abs=2e-3)
    assert any(note.startswith("WLF with C1 = 8.8") for note in shifts["notes"])
    assert [each["svg"][:5] for each in found["drawings"]] == ["<?xml"]
    case = client.post("/api/case", json={"yaml": CASE}).json()["case"] | {
        "material": found["material"]
    }
    text = client.post("/api/yaml", json={"case": case, "yaml": CASE}).json()["yaml"]
    material = read_case_text(text, "case.yaml").material
    assert isinstance(material, vc.Material)
    assert material.law.times == close_to(TIMES, rel=2e-2)
    # The same section as that of the command line.
    (tmp_path / "dma.csv").write_bytes(swept())
    assert main(["fit", str(tmp_path / "dma.csv"), "--poisson-ratio", "0.5"]) == 0
    assert found["yaml"] in capsys.readouterr().out


def test_a_rule_takes_the_place_of_the_factors(client: TestClient) -> None:
    shift = fitted(client, poisson_ratio="0.5", shift="wlf")["material"]["shift"]
    assert shift["kind"] == "wlf"
    assert float(shift["c1"]) == close_to(8.86, rel=2e-2)


def test_one_set_is_fitted_without_shift_factors(client: TestClient) -> None:
    found = fitted(client, file="one.csv", poisson_ratio="0.5")
    assert found["shifts"] is None
    assert found["material"]["law"] == "relaxation-series"


def test_contents_name_the_fit_that_takes_a_file(client: TestClient) -> None:
    many, one = (client.get(f"/api/files/{n}.csv/contents").json() for n in ("dma", "one"))
    assert (many["holds"], many["section"], many["fit"]) == (
        "5 tests of a material",
        None,
        "material",
    )
    assert (one["section"]["law"], one["fit"]) == ("table", "material")


@pytest.mark.parametrize(
    ("changed", "path", "message"),
    [
        ({"file": "none.csv"}, "file", "there is no file"),
        ({"reference": "20"}, "reference", "20"),
        ({"shift": "guess"}, "shift", "must be one of"),
        ({"data": "uniaxial"}, "poisson_ratio", "uniaxial data need"),
        ({"terms": "few"}, "terms", "a whole number"),
        ({"vertical": "up"}, "", "vertical"),
        ({"reference": "90 degC"}, "reference", "0 °C to 40 °C, got 90 °C"),
        ({"poisson_ratio": "half"}, "poisson_ratio", "is not a number"),
    ],
)
def test_what_cannot_be_fitted_is_refused_at_its_field(
    client: TestClient, changed: dict[str, str], path: str, message: str
) -> None:
    answer = client.post("/api/fit/material", json={"file": "dma.csv", **changed})
    assert answer.status_code == 422, answer.text
    (problem,) = answer.json()["problems"]
    assert problem["path"] == path, problem
    assert message in problem["message"]


@pytest.mark.slow  # a server and a browser
@pytest.mark.skipif(seen.BROWSER is None, reason="there is no Chromium")
def test_a_table_of_several_temperatures_is_opened_fitted_and_used(tmp_path: Path) -> None:
    pytest.importorskip("playwright")
    (tmp_path / "dma.csv").write_bytes(swept())
    with seen.served(tmp_path / "page") as server, seen.opened_browser() as browser:
        page, watched = seen.new_page(browser, server)
        seen.visit(page, server, CASE)
        page.set_input_files("#open-file", tmp_path / "dma.csv")
        page.wait_for_selector("#fit-reference:visible")
        assert page.input_value("#fit-file") == "dma.csv"
        assert page.is_hidden("#fit-tip")
        page.fill("#fit-poisson_ratio", "0.5")
        page.click("#fit-go")
        page.wait_for_selector("#fit-shift-table tbody tr", timeout=60_000)
        assert page.locator("#fit-shift-table tbody tr").count() == 5
        page.wait_for_selector("#fit-drawings img")
        with page.expect_response("**/api/check"):
            page.click("#fit-use")
        seen.until_checked(page)
        text = page.evaluate("sessionStorage['viscontact.case']")
        material = read_case_text(text, "case.yaml").material
        assert isinstance(material, vc.Material)
        assert len(material.law.times) == len(TIMES)
        for width in (390, 1280):
            page.set_viewport_size({"width": width, "height": 844})
            assert page.evaluate("document.documentElement.scrollWidth") == width
        assert watched.faults == []
