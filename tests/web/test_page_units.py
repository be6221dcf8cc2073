"""Units of the calculator page are those of the package, in every system."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fastapi.testclient import TestClient

import web.served_page as seen
from viscontact.results.variables import SCALARS
from viscontact.units.formatting import unit_ladder
from viscontact.units.systems import SYSTEM_NAMES, SYSTEMS, unit_in
from web.calculator_page import asking

#: SI values in all decades, beside the limits of units, and the instants at which units change.
SIZES = [0.0, *np.geomspace(0.9985e-20, 0.9985e13, 34), 9999.0, 1e4, 10001.0, 2.6e5, 2.7e5]


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    with asking(tmp_path_factory.mktemp("page")) as client:
        yield client


def test_the_table_of_units_has_every_system_and_every_unit_of_a_scalar(
    client: TestClient,
) -> None:
    table = client.get("/api/units").json()
    assert list(table["systems"]) == list(SYSTEMS) == list(SYSTEM_NAMES)
    for name, units in SYSTEMS.items():
        found = table["systems"][name]["units"]
        assert {si: (unit["symbol"], unit["factor"]) for si, unit in found.items()} == {
            si: (unit.symbol, unit.factor) for si, unit in units.items()
        }
    assert set(table["ladders"]) >= {each.units for each in SCALARS.values()} | {"s", "m/s"}
    for si, ladder in table["ladders"].items():
        assert [(each["symbol"], each["factor"], each["least"]) for each in ladder] == [
            (unit.symbol, unit.factor, least) for unit, least in unit_ladder(si)
        ]
        assert any(each["factor"] == 1 for each in ladder)  # the unit of zeros


@pytest.mark.slow  # a server and a browser
@pytest.mark.skipif(seen.BROWSER is None, reason="there is no Chromium")
def test_the_page_chooses_the_units_of_the_package(tmp_path: Path) -> None:
    pytest.importorskip("playwright")
    with seen.served(tmp_path) as server, seen.opened_browser() as browser:
        page, watched = seen.new_page(browser, server)
        seen.visit(page, server)
        quantities = sorted({each.units for each in SCALARS.values()} | {"s", "m/s"})
        chosen: dict[str, Any] = page.evaluate(
            """async ([systems, quantities, sizes]) => {
              const { unitFor, useSystem } = await import("/static/units.js");
              return Object.fromEntries(systems.map((system) => {
                useSystem(system);
                return [system, quantities.map((si) => sizes.map((size) => unitFor(si, size)))];
              }));
            }""",
            [list(SYSTEMS), quantities, SIZES],
        )
        assert watched.faults == []
    assert list(chosen) == list(SYSTEMS)
    for system, of_quantities in chosen.items():
        for si, found in zip(quantities, of_quantities, strict=True):
            for size, unit in zip(SIZES, found, strict=True):
                wanted = unit_in(system, si, size)
                assert (unit["symbol"], unit["factor"]) == (wanted.symbol, wanted.factor), (
                    f"{system}: {size} {si}"
                )
