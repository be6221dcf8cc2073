"""Cylinders with waves along them, on grids that are periodic along the waves, in two limits.

A wide strip in full contact carries Hertz's pressure and that of the waves; a light load is carried
by one elliptical contact on each crest.
"""

import math

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.reference import full_contact_pressure, hertz_elliptical, hertz_line
from viscontact.verify.case import observed_order

from .pressing import ELASTIC, MODULUS

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

RADIUS, WIDTH = 5e-3, 5e-5  # of the cylinder, and half width of its strip [m]
LINE_LOAD = math.pi * MODULUS * WIDTH**2 / (4 * RADIUS)
WAVELENGTH = WIDTH / 4
HERTZ = hertz_line(LINE_LOAD, RADIUS, MODULUS)
#: Of waves that press with a fifth of Hertz's pressure.
AMPLITUDE = 0.2 * HERTZ.peak_pressure * WAVELENGTH / (math.pi * MODULUS)


def wavy(amplitude=AMPLITUDE, wavelength=WAVELENGTH):
    return vc.Paraboloid(math.inf, RADIUS) + vc.Waviness(amplitude, wavelength_x=wavelength)


def pressure_along(cells, material=ELASTIC, times=(0.0,), margin=1.2):
    """Pressure on the axis, with `cells` to a wave, shape (times, cells), and their places."""
    edge = WAVELENGTH / cells
    across = 2 * math.ceil(margin * WIDTH / edge) + 1
    grid = vc.Grid((cells, across), (WAVELENGTH, across * edge), periodic=(True, False))
    load = vc.step(LINE_LOAD * WAVELENGTH)
    ds = vc.simulate(wavy(), material, load, grid, times, tolerance=1e-9, errors=False)
    return ds.pressure.values[:, :, across // 2], grid.x


def waves_in(pressure, x):
    """Amplitude of the waves, and the mean."""
    return 2 * float((pressure * np.cos(2 * np.pi * x / WAVELENGTH)).mean()), float(pressure.mean())


def test_waves_in_full_contact_press_as_westergaards():
    """Far from the rim: p0 + p* cos(2π x/λ), p* = π E* Δ/λ (Johnson 1985, section 13.2)."""
    exact = full_contact_pressure(AMPLITUDE, MODULUS, wavelength_x=WAVELENGTH)
    levels, errors = (12, 24, 36), []
    for cells in levels:
        (pressure,), x = pressure_along(cells)
        amplitude, mean = waves_in(pressure, x)
        errors.append(abs(amplitude - exact) / exact)
        # Waves at the rim, which is not in full contact, spread the load a little.
        assert mean == close_to(HERTZ.peak_pressure, rel=5e-4)
    assert errors[-1] < 2e-3
    assert observed_order(levels, errors) == close_to(2.0, abs=0.2)


def test_pressure_of_waves_relaxes_where_the_strip_creeps():
    """In full contact the waves' displacement is constant: p* follows the relaxation modulus."""
    law = vc.Zener(0.35 * MODULUS, 0.35 * MODULUS, 3.5 * MODULUS)
    body = vc.Material(law, poisson_ratio=0.3)
    times = np.array([0.0, 2.0, 5.0, 20.0])
    fine = np.unique(np.concatenate([np.linspace(0, 20, 41), times]))
    fields, x = pressure_along(12, body, fine, margin=1.7)
    found = np.array([waves_in(field, x)[0] for field in fields])
    expected = law.relaxation(fine) / law.relaxation(0.0)
    assert found / found[0] == close_to(expected, rel=2e-3)


def test_light_load_is_carried_by_ellipses_on_the_crests():
    """Radii λ²/(4π² Δ) and R; neighbours at the distance λ change the contact by (a/λ)³."""
    wavelength, amplitude = 1e-3, 5e-7
    along, force = wavelength**2 / (4 * math.pi**2 * amplitude), 1.25e-13 * MODULUS
    exact = hertz_elliptical(force, along, RADIUS, MODULUS)
    assert exact.semi_axis_x < 0.025 * wavelength
    size = (wavelength, 2.6 * exact.semi_axis_y)
    grid = vc.Grid((420, 26), size, periodic=(True, False))
    body = wavy(amplitude, wavelength)
    ds = vc.simulate(body, ELASTIC, vc.step(force), grid, [0.0], errors=False)
    # 19 cells lie along, 20 across; the tips of a slender contact are the least accurate.
    assert float(ds.contact_length[0]) / 2 == close_to(exact.semi_axis_x, rel=1e-2)
    assert float(ds.contact_width[0]) / 2 == close_to(exact.semi_axis_y, rel=5e-3)
    assert float(ds.peak_pressure[0]) == close_to(exact.peak_pressure, rel=5e-3)


@pytest.mark.slow
def test_error_bars_of_wavy_cylinders_hold():
    """Against cells of a third, random waves from spots to full contact."""
    random, missed, total = np.random.default_rng(4000), 0, 0
    for _ in range(14):
        wavelength = WIDTH * random.uniform(0.7, 3.0)
        peak = HERTZ.peak_pressure * random.uniform(0.2, 1.2)
        body = wavy(peak * wavelength / (math.pi * MODULUS), wavelength)
        load = vc.step(LINE_LOAD * wavelength * random.uniform(0.3, 1.2))
        cells = 2 * random.integers(8, 18), 2 * random.integers(12, 24)
        coarse, fine = (
            vc.simulate(
                body,
                ELASTIC,
                load,
                vc.Grid(
                    (times * int(cells[0]), times * int(cells[1])),
                    (wavelength, 3.6 * WIDTH),
                    periodic=(True, False),
                ),
                [0.0],
                fields="none",
                errors=times == 1,
            )
            for times in (1, 3)
        )
        for name in ("contact_area", "contact_width", "contact_length", "peak_pressure"):
            error = abs(float(coarse[name][0] - fine[name][0]))
            missed += error > float(coarse[f"{name}_error"][0])
            total += 1
    assert missed <= 0.06 * total  # 3 of 56
