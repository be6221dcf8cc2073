"""Fit of force curves on the calculator page: the answers, and the panel in a browser."""

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
from web.refused_requests import assert_refused

CELL = Path(__file__).parents[1] / "identification" / "cell.jpk-force"
ASKED = {"file": "curve.csv", "size": "5 um", "law": "elastic", "poisson_ratio": "0.5"}


def curve(header: str = "time [s], position [um], deflection [nm]") -> bytes:
    """Elastic body with E* = 20 kPa (Hertz), 0.1 N/m, contact at 3 um, noise of 1 nm."""
    depth = np.linspace(0, 1e-6, 200)
    bending = 4 / 3 * 20e3 * np.sqrt(5e-6) * depth**1.5 / 0.1
    position = np.append(np.linspace(0, 2.99e-6, 300), 3e-6 + depth + bending)
    deflection = np.append(np.zeros(300), bending) + 0.003 * position
    deflection += 1e-9 * np.random.default_rng(0).standard_normal(500)
    rows = np.column_stack([position / 4e-6, position * 1e6, deflection * 1e9])
    return "\n".join([header, *(", ".join(map(repr, row)) for row in rows.tolist())]).encode()


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    with asking(tmp_path_factory.mktemp("page")) as client:
        assert client.post("/api/files?name=curve.csv", content=curve()).status_code == 201
        assert client.post(f"/api/files?name={CELL.name}", content=CELL.read_bytes()).is_success
        yield client


def test_a_table_is_fitted_and_its_law_is_a_material(client: TestClient) -> None:
    answer = client.post("/api/fit", json=ASKED | {"spring_constant": "0.1 N/m"})
    assert answer.status_code == 200, answer.text
    found = answer.json()
    # E* = 20 kPa and nu = 1/2: G = E* (1 - nu)/2 = 5 kPa.
    case = {"yaml": CASE, "case": client.post("/api/case", json={"yaml": CASE}).json()["case"]}
    case["case"]["material"] = found["material"]
    text = client.post("/api/yaml", json=case).json()["yaml"]
    material = read_case_text(text, "case.yaml").material
    assert isinstance(material, vc.Material)
    assert isinstance(material.law, vc.Elastic)
    assert material.law.shear_modulus == close_to(5e3, rel=1e-2)
    row, youngs = found["parameters"]
    assert (row["name"], row["confidence"]) == ("shear_modulus", "95 %")
    assert youngs["name"] == "youngs_modulus"
    low, high, unit = row["interval"].replace("to ", "").split()
    assert float(low) < 1e-3 * material.law.shear_modulus < float(high)
    assert unit == "kPa"
    at, _, error = dict(found["contact"])["Contact point"].partition(" µm ± ")
    assert abs(float(at) - 3) < 3e-3 * float(error.removesuffix(" nm"))
    names = [figure["layout"]["meta"]["name"] for figure in found["figures"]]
    assert names == ["fit-contact", "fit-loop", "fit-time"]


@pytest.mark.parametrize("units", ["us", pytest.param("si", marks=pytest.mark.slow)])
def test_figures_have_the_chosen_units(client: TestClient, units: str) -> None:
    asked = ASKED | {"spring_constant": "0.1 N/m"}
    first, *_ = client.post(f"/api/fit?units={units}", json=asked).json()["figures"]
    unit = {"us": "in", "si": "m"}[units]
    assert first["layout"]["xaxis"]["title"]["text"] == f"Position [{unit}]"


def test_a_record_without_a_cantilever_is_fitted(client: TestClient) -> None:
    depth = np.linspace(0, 1e-6, 40)
    force = 4 / 3 * 20e3 * np.sqrt(5e-6) * depth**1.5
    rows = np.column_stack([np.linspace(0, 1, 40), depth * 1e9, force * 1e9])
    lines = [", ".join(map(repr, row)) for row in rows.tolist()]
    content = "\n".join(["time [s], approach [nm], force [nN]", *lines])
    client.post("/api/files?name=record.csv", content=content.encode())
    found = client.post("/api/fit", json=ASKED | {"file": "record.csv"}).json()
    assert found["contact"] == []
    assert [each["layout"]["meta"]["name"] for each in found["figures"]] == ["fit-loop", "fit-time"]
    assert found["material"]["shear_modulus"] == "5000 Pa"


@pytest.mark.slow
def test_a_file_of_an_instrument_gives_the_law_of_the_command_line(
    client: TestClient, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("afmformats")
    answer = client.post("/api/fit", json=ASKED | {"file": CELL.name, "size": "2.5 um"})
    assert answer.status_code == 200, answer.text
    command = ["fit", str(CELL), "--indenter", "sphere 2.5 um", "--poisson-ratio", "0.5"]
    assert main([*command, "--law", "elastic"]) == 0
    assert answer.json()["yaml"] in capsys.readouterr().out


@pytest.mark.parametrize(
    ("changed", "path", "message"),
    [
        ({}, "spring_constant", "needs the spring constant, such as 0.1 N/m"),
        ({"spring_constant": "1 N"}, "spring_constant", "'1 N'"),
        ({"file": "none.csv"}, "file", "there is no file 'none.csv'"),
        ({"file": "../curve.csv"}, "file", "give its name alone"),
        ({"file": ""}, "file", "give its name alone"),
        ({"size": ""}, "size", "is missing"),
        ({"size": "5 N"}, "size", "'5 N'"),
        ({"tip": "spoon"}, "tip", "must be one of sphere, cone, pyramid, punch"),
        ({"poisson_ratio": "half"}, "poisson_ratio", "'half' is not a number"),
        ({"poisson_ratio": ""}, "poisson_ratio", "give Poisson's ratio"),
        ({"poisson_ratio": "0.7", "spring_constant": "0.1 N/m"}, "", "poisson_ratio"),
        ({"law": "wood", "spring_constant": "0.1 N/m"}, "", "law must be one of elastic"),
        ({"file": "volts.csv", "spring_constant": "0.1 N/m"}, "", "in volts needs the sensitivity"),
        ({"file": "flat.csv", "spring_constant": "0.1 N/m"}, "", "no contact is found"),
        ({"file": "creep.csv", "spring_constant": "0.1 N/m"}, "", "a force curve has columns"),
    ],
)
def test_what_cannot_be_fitted_is_refused_at_its_field(
    client: TestClient, changed: dict[str, str], path: str, message: str
) -> None:
    volts = curve("time [s], position [um], deflection [V]")
    flat = "\n".join(
        ["time [s], position [um], deflection [nm]", *(f"{i},{i},{i % 2}" for i in range(99))]
    )
    creep = "time [s], J [1/MPa]\n1, 1\n2, 2\n"
    for name, content in {"volts": volts, "flat": flat.encode(), "creep": creep.encode()}.items():
        client.post(f"/api/files?name={name}.csv", content=content)
    answer = client.post("/api/fit", json=ASKED | changed)
    assert_refused(answer, path, message)


@pytest.mark.slow  # a server and a browser
@pytest.mark.skipif(seen.BROWSER is None, reason="there is no Chromium")
def test_a_curve_is_dropped_fitted_and_used(tmp_path: Path) -> None:
    pytest.importorskip("playwright")
    with seen.served(tmp_path) as server, seen.opened_browser() as browser:
        page, watched = seen.new_page(browser, server)
        seen.visit(page, server, CASE)
        page.click("#fit summary")
        handed: dict[str, Any] = {"text": curve().decode()}
        with page.expect_response("**/api/files?name=curve.csv"):
            page.evaluate(
                """({ text }) => {
                  const dataTransfer = new DataTransfer();
                  dataTransfer.items.add(new File([text], "curve.csv"));
                  const about = { dataTransfer, bubbles: true, cancelable: true };
                  document.getElementById("fit-form").dispatchEvent(new DragEvent("drop", about));
                }""",
                handed,
            )
        page.select_option("#fit-law", "elastic")
        for name, text in {"size": "5 um", "spring_constant": "0.1 N/m"}.items():
            page.fill(f"#fit-{name}", text)
        page.fill("#fit-poisson_ratio", "0.5")
        page.click("#fit-go")
        page.wait_for_selector("#fit-figures .plot .main-svg", timeout=60_000)
        assert page.locator("#fit-figures .panel").count() == 3
        assert "kPa" in page.inner_text("#fit-parameters")
        with page.expect_response("**/api/check"):
            page.click("#fit-use")
        seen.until_checked(page)
        text = page.evaluate("sessionStorage['viscontact.case']")
        assert isinstance(read_case_text(text, "case.yaml").material.law, vc.Elastic)
        assert page.locator('[id="field-material.law"]').input_value() == "elastic"
        assert page.evaluate("document.documentElement.scrollWidth") == 1280
        assert watched.faults == []
