"""Moving contacts on the calculator page: the case in the form, and live numbers."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from viscontact.results.run_files import PROGRESS_NAME
from viscontact.web.runs.live_scalars import grown
from web.calculator_page import CASE, asking

TRAVEL = CASE.replace("time: {end: 5 s, steps: 4}", "time: {end: 5 s, spacing: cells}").replace(
    "grid:", "motion: {kind: travel, points: [[0 s, 0 mm], [5 s, 0.4 mm]], along: x}\ngrid:"
)
RECIPROCATING = TRAVEL.replace(
    "{kind: travel, points: [[0 s, 0 mm], [5 s, 0.4 mm]], along: x}",
    "{kind: reciprocating, amplitude: 0.2 mm, period: 2 s, cycles: 2, rolling: true}",
)


@pytest.fixture
def client(tmp_path: Path) -> Iterator[TestClient]:
    with asking(tmp_path / "page") as client:
        yield client


@pytest.mark.parametrize("case", [TRAVEL, RECIPROCATING])
def test_motion_goes_into_the_form_and_back(client: TestClient, case: str) -> None:
    given = client.post("/api/case", json={"yaml": case}).json()["case"]
    assert given["motion"]["kind"] in ("travel", "reciprocating")
    written = client.post("/api/yaml", json={"case": given, "yaml": "", "titled": True}).json()
    assert client.post("/api/case", json={"yaml": written["yaml"]}).json()["case"] == given
    assert client.post("/api/check", json={"yaml": written["yaml"]}).status_code == 200


def test_friction_is_a_live_number_of_moving_contacts_only(tmp_path: Path) -> None:
    line = {"time": 0.0, "contact_area": 1e-6, "approach": 1e-5, "peak_pressure": 1e6}
    log = tmp_path / PROGRESS_NAME
    log.write_text(json.dumps(line) + "\n", encoding="utf-8")
    assert list(grown(tmp_path, 0)["labels"]) == ["contact_area", "approach", "peak_pressure"]
    moving = [line | {"friction_coefficient": None}, line | {"friction_coefficient": 0.02}]
    log.write_text("".join(json.dumps(each) + "\n" for each in moving), encoding="utf-8")
    found = grown(tmp_path, 0)
    assert found["labels"]["friction_coefficient"] == "Friction coefficient"
    assert found["scalars"]["friction_coefficient"] == [None, 0.02]
