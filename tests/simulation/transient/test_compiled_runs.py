"""Runs with the compiled inner loops against those of NumPy."""

from __future__ import annotations

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.backend import compiled

pytestmark = pytest.mark.skipif(compiled.core is None, reason="no compiled core")

ZENER = vc.Material(vc.Zener(1e7, 1e7, 1e7), 0.4)
LOADS = {
    "held and eccentric": vc.step(4.0, eccentricity_x=2e-5),
    "up and down": vc.ForceHistory([0.0, 1.0, 2.0], [0.0, 4.0, 0.2]),
    "given approach": vc.ApproachHistory([0.0, 1.0, 2.0], [0.0, 4e-5, 1e-5]),
}
SHAPES = {
    "sphere": (vc.Sphere(1e-2), vc.Grid((40, 44), (3e-3, 3e-3))),
    "punch": (vc.FlatPunch(half_length=6e-4, half_width=4e-4), vc.Grid((44, 40), (2e-3, 2e-3))),
    "wavy": (
        vc.Waviness(2e-6, wavelength_x=1e-3, wavelength_y=1e-3),
        vc.Grid((32, 32), (1e-3, 1e-3), periodic=(True, True)),
    ),
}


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
@pytest.mark.parametrize(
    ("shape", "load"),
    [*((shape, load) for shape in ("sphere", "punch") for load in LOADS), ("wavy", "up and down")],
)
def test_a_run_takes_the_same_steps_and_agrees_within_the_tolerance(
    shape: str, load: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    indenter, grid = SHAPES[shape]
    given = indenter, ZENER, LOADS[load], grid, np.linspace(0.1, 2.0, 12)
    found = vc.simulate(*given, errors=False)
    monkeypatch.setattr(compiled, "core", None)
    expected = vc.simulate(*given, errors=False)
    assert (found.attrs["inner_loops"], expected.attrs["inner_loops"]) == ("compiled", "numpy")
    np.testing.assert_array_equal(found.time, expected.time)
    peak = float(expected.pressure.max())
    np.testing.assert_allclose(found.pressure, expected.pressure, atol=2e-4 * peak)
    for name in ("peak_pressure", "contact_area", "force"):
        np.testing.assert_allclose(found[name], expected[name], rtol=1e-4, atol=1e-12 * peak)
    assert float(found.pressure.max()) == close_to(peak, 2e-5)
