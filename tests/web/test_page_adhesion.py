"""Fit of a sphere that adheres on the calculator page: the answers, and the panel in a browser."""

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
from identification.adhesive_curves import RADIUS, curve_of
from viscontact.case import Case, read_case_text
from viscontact.cli import main
from viscontact.reference import jkr_sphere, maugis_dugdale
from web.calculator_page import CASE, asking
from web.refused_requests import assert_refused

MODULUS, WORK, SPRING = 2e6, 0.02, 3.0
#: Range of a Tabor number of 1 [m].
LENGTH = float(np.cbrt(RADIUS * (WORK / MODULUS) ** 2))
ASKED = {"file": "curve.csv", "size": "5 um", "poisson_ratio": "0.5"}
STIFFNESS = {"spring_constant": "3 N/m"}


def curve(tabor: float) -> bytes:
    """Curve of a sphere, by Maugis or, of an infinite Tabor number, by JKR."""
    sphere = jkr_sphere(RADIUS, 1 / MODULUS, WORK)
    if tabor < np.inf:
        sphere = maugis_dugdale(RADIUS, 1 / MODULUS, WORK, LENGTH / tabor)
    found = curve_of(sphere, SPRING, 0.001, np.random.default_rng(7), rows=200)
    rows = np.c_[found.times, 1e6 * found.position, 1e9 * found.deflection].tolist()
    lines = [", ".join(f"{each:.9g}" for each in row) for row in rows]
    return "\n".join(["time [s], position [um], deflection [nm]", *lines]).encode()


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    with asking(tmp_path_factory.mktemp("page")) as client:
        for name, tabor in {"curve.csv": 0.5, "jkr.csv": np.inf}.items():
            assert client.post(f"/api/files?name={name}", content=curve(tabor)).status_code == 201
        yield client


def fitted(client: TestClient, **changed: str) -> dict[str, Any]:
    answer = client.post("/api/fit/adhesion", json=ASKED | STIFFNESS | changed)
    assert answer.status_code == 200, answer.text
    found: dict[str, Any] = answer.json()
    return found


def read(client: TestClient, found: dict[str, Any]) -> Case:
    """Case of the page whose material and adhesion are those of a fit."""
    given = client.post("/api/case", json={"yaml": CASE}).json()["case"]
    given |= {"material": found["material"], "adhesion": found["adhesion"]}
    text = client.post("/api/yaml", json={"case": given, "yaml": CASE}).json()["yaml"]
    return read_case_text(text, "case.yaml")


def test_a_curve_gives_the_work_range_and_modulus_of_maugis(
    client: TestClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    found = fitted(client)
    case = read(client, found)
    assert case.adhesion is not None
    assert case.adhesion.work == close_to(WORK, rel=0.05)
    assert case.adhesion.range == close_to(2 * LENGTH, rel=0.05)
    assert isinstance(case.material, vc.Material)
    assert isinstance(case.material.law, vc.Elastic)
    # E/(1 - nu²) = 2 G/(1 - nu), nu = 1/2
    assert case.material.law.shear_modulus == close_to(MODULUS / 4, rel=0.05)
    rows = {row["name"]: row for row in found["parameters"]}
    assert [*rows] == ["contact_modulus", "work", "tabor_number", "range"]
    for name, exact in {"contact_modulus": 2.0, "tabor_number": 0.5}.items():
        low, high, *unit = rows[name]["interval"].replace("to ", "").split()
        assert float(low) <= exact <= float(high)
        assert unit == (["MPa"] if name == "contact_modulus" else [])
    facts = dict(found["contact"])
    assert float(facts["Contact point"].split(" µm")[0]) == close_to(1.0, rel=0.01)
    assert facts["Limit"].startswith("between DMT's limit")
    assert [each["svg"][:5] for each in found["drawings"]] == ["<?xml"]
    # The same sections as those of the command line.
    path = tmp_path / "curve.csv"
    path.write_bytes(curve(0.5))
    command = ["fit", str(path), "--adhesion", "--indenter", "sphere 5 um"]
    assert main([*command, "--poisson-ratio", "0.5", "--spring-constant", "3 N/m"]) == 0
    assert found["yaml"] in capsys.readouterr().out


def test_a_range_that_the_curve_does_not_tell_is_left_out(client: TestClient) -> None:
    found = fitted(client, file="jkr.csv")
    rows = {row["name"]: row for row in found["parameters"]}
    assert rows["range"]["value"] == rows["tabor_number"]["value"] == "not determined"
    assert rows["range"]["interval"].startswith("below ")
    assert rows["tabor_number"]["interval"].startswith("above ")
    case = read(client, found)
    assert case.adhesion is not None
    assert case.adhesion.range is None
    assert case.adhesion.work == close_to(WORK, rel=0.05)


@pytest.mark.parametrize(
    ("changed", "path", "message"),
    [
        ({}, "spring_constant", "needs the spring constant, such as 0.1 N/m"),
        ({"size": ""}, "size", "the radius of the sphere, such as 5 um"),
        ({"size": "5 N"}, "size", "'5 N'"),
        ({"poisson_ratio": ""}, "poisson_ratio", "give Poisson's ratio"),
        ({"poisson_ratio": "0.7"} | STIFFNESS, "", "poisson_ratio"),
        ({"file": "none.csv"} | STIFFNESS, "file", "there is no file 'none.csv'"),
        ({"file": "loads.csv"} | STIFFNESS, "", "a force curve has columns"),
    ],
)
def test_what_cannot_be_fitted_is_refused_at_its_field(
    client: TestClient, changed: dict[str, str], path: str, message: str
) -> None:
    client.post("/api/files?name=loads.csv", content=b"time [s], force [N]\n0, 0\n1, 2\n")
    answer = client.post("/api/fit/adhesion", json=ASKED | changed)
    assert_refused(answer, path, message)


@pytest.mark.slow  # a server and a browser
@pytest.mark.skipif(seen.BROWSER is None, reason="there is no Chromium")
def test_a_sphere_that_sticks_is_fitted_and_used(tmp_path: Path) -> None:
    pytest.importorskip("playwright")
    with seen.served(tmp_path) as server, seen.opened_browser() as browser:
        page, watched = seen.new_page(browser, server)
        seen.visit(page, server, CASE)
        page.click("#fit summary")
        page.select_option("#fit-kind", "adhesion")
        page.set_input_files(
            "#fit-form input[type=file]",
            [{"name": "curve.csv", "mimeType": "text/csv", "buffer": curve(0.5)}],
        )
        page.wait_for_function("() => document.getElementById('fit-file').value === 'curve.csv'")
        assert page.input_value("#fit-kind") == "adhesion"
        assert page.is_hidden("#fit-tip")
        assert page.is_hidden("#fit-law")
        for name, text in {"size": "5 um", "spring_constant": "3 N/m"}.items():
            page.fill(f"#fit-{name}", text)
        page.fill("#fit-poisson_ratio", "0.5")
        page.click("#fit-go")
        page.wait_for_selector("#fit-drawings img", timeout=60_000)
        assert "MPa" in page.inner_text("#fit-parameters")
        for width in (1280, 390):  # no column is cut
            page.set_viewport_size({"width": width, "height": 900})
            beyond = "e => e.scrollWidth - e.clientWidth"
            assert page.eval_on_selector("#fit-parameters", beyond) == 0
        page.set_viewport_size({"width": 1280, "height": 900})
        assert page.inner_text("#fit-use") == "Use as material and adhesion"
        with page.expect_response("**/api/check"):
            page.click("#fit-use")
        seen.until_checked(page)
        text = page.evaluate("sessionStorage['viscontact.case']")
        case = read_case_text(text, "case.yaml")
        assert case.adhesion is not None
        assert case.adhesion.work == close_to(WORK, rel=0.05)
        assert page.evaluate("document.documentElement.scrollWidth") == 1280
        assert watched.faults == []
