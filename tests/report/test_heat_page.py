"""Page of heat balances against its table."""

from __future__ import annotations

import warnings
from pathlib import Path

import pytest

import viscontact as vc
from rolling_curves import rolling_curve


def test_page_has_the_balances_the_runaway_and_what_is_not_reached(tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        found = vc.rolling_temperature(
            rolling_curve(error=0.0),
            **{"cooling": 10.0, "ambient": 333.15, "conductivity": 0.2},
            **{"heat_capacity": 1800.0, "density": 1150.0},
            speed=[0.01, 0.1, 9000.0],
        )
    found.report(tmp_path / "heat.html")
    page = (tmp_path / "heat.html").read_text(encoding="utf-8")
    assert page.count("<figure") == 3
    assert "Heat balance: Covered roll" in page
    for text in (str(found), *found.notes):
        assert text in page
    for cell in ("unstable", "ambient", "60 °C", "10 W/(m2 K)", "1150 kg/m³", "insulated", "8 mm"):
        assert (f"<td>{cell}</td>" in page) is (cell != "unstable" or not found.stable.all())


@pytest.mark.parametrize("name", ["heat_balance", "rolling_temperature"])
def test_single_speed_is_drawn(name: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        found = vc.rolling_temperature(rolling_curve(), cooling=10.0, ambient=333.15, speed=0.1)
    assert getattr(vc.plot, name)(found.table).axes
