"""Verification cases of periodic wavy surfaces up to full contact."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Waviness
from viscontact.bodies.laws import Zener
from viscontact.bodies.loads import step
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.state import ContactState
from viscontact.reference import WavyContact, full_contact_pressure, westergaard
from viscontact.simulation.transient.state_generator import march
from viscontact.verify.case import Case, Comparison, Quantity, single
from viscontact.verify.elastic import BODY, MODULUS

_WAVE, _HEIGHT = 1e-3, 1e-6  # wavelength and amplitude [m]
_RIDGES = Waviness(_HEIGHT, wavelength_x=_WAVE)
_CROSSED = Waviness(_HEIGHT, wavelength_x=_WAVE, wavelength_y=_WAVE)
_FLAT = full_contact_pressure(_HEIGHT, MODULUS, wavelength_x=_WAVE)
_FLAT_CROSSED = full_contact_pressure(_HEIGHT, MODULUS, wavelength_x=_WAVE, wavelength_y=_WAVE)

#: Parts of the pressure of full contact over which errors are averaged: the rim is at
#: random positions in the cells.
_PARTS = (0.2, 0.3, 0.4, 0.5, 0.6, 0.7)

_CREEPING = Material(Zener(0.35 * MODULUS, 0.35 * MODULUS, 3.5 * MODULUS), poisson_ratio=0.3)
_INSTANTS = np.append(0.0, np.geomspace(0.1, 40.0, 40))  # [s]; retardation time 10 s


def _strip(cells: int) -> Grid:
    return Grid((cells, 4), (_WAVE, 4 * _WAVE / cells), periodic=True)


def _mean(pairs: list[tuple[WavyContact, ContactState]]) -> tuple[Comparison, ...]:
    """Approach and width of the strips, with the mean error of all pairs."""
    read: tuple[Callable[[WavyContact, ContactState], tuple[float, float]], ...] = (
        lambda exact, state: (exact.approach, state.approach),
        lambda exact, state: (2 * exact.half_width, state.contact_length),
    )
    found = []
    for values in read:
        singles = [single(*values(exact, state)) for exact, state in pairs]
        error = float(np.mean([one.error for one in singles]))
        found.append(Comparison(singles[-1].exact, singles[-1].ours, error))
    return tuple(found)


def _ridges(cells: int) -> tuple[Comparison, ...]:
    grid, pairs, apart = _strip(cells), [], []
    for part in _PARTS:
        exact = westergaard(part * _FLAT, _HEIGHT, _WAVE, MODULUS)
        load = step(part * _FLAT * grid.area)
        state = next(march(_RIDGES, BODY, load, grid, [0.0], tolerance=1e-8))
        pairs.append((exact, state))
        off = np.abs(state.pressure[:, 0] - exact.pressure(grid.x)).mean()
        apart.append(float(off) / exact.peak_pressure)
    peak = single(float(exact.pressure(grid.x[cells // 2])), state.peak_pressure)
    return (*_mean(pairs), Comparison(peak.exact, peak.ours, float(np.mean(apart))))


def _creeping(cells: int) -> tuple[Comparison, ...]:
    """Approach and width while the troughs are open: in full contact the extent is exact."""
    grid, mean = _strip(cells), 0.6 * _FLAT
    compliance = _CREEPING.contact_compliance()
    states = march(_RIDGES, _CREEPING, step(mean * grid.area), grid, _INSTANTS, tolerance=1e-8)
    pairs = [
        (westergaard(mean, _HEIGHT, _WAVE, 1 / float(compliance(state.time))), state)
        for state in states
    ]
    return _mean([(exact, state) for exact, state in pairs if exact.ratio < 0.95])


def _flat(cells: int) -> tuple[Comparison, ...]:
    """Amplitude of the pressure above full contact, where it is p̄ - p* in the deepest trough."""
    grid = Grid((cells, cells), (_WAVE, _WAVE), periodic=True)
    load = step(1.01 * _FLAT_CROSSED * grid.area)
    state = next(march(_CROSSED, BODY, load, grid, [0.0], tolerance=1e-8))
    wave = 1 - _CROSSED.gap(grid.x[:, None], grid.y[None, :]) / _HEIGHT
    share = float((state.pressure * wave).sum() / np.square(wave).sum())
    return single(_FLAT_CROSSED, share), single(_WAVE**2, state.contact_area)


CASES: tuple[Case, ...] = (
    Case(
        "straight waves, periodic",
        "Westergaard 1939",
        (
            Quantity("approach", "m", 3e-3, 2e-4),
            Quantity("contact width", "m", 3e-2, 4e-3),
            Quantity("pressure", "Pa", 5e-3, 6e-4),
        ),
        (16, 32, 64, 128),
        _ridges,
    ),
    Case(
        "straight waves, periodic, sudden force, Zener",
        "Westergaard 1939, Lee & Radok 1960",
        (Quantity("approach", "m", 3e-3, 2e-4), Quantity("contact width", "m", 3e-2, 4e-3)),
        (16, 32, 64, 128),
        _creeping,
    ),
    Case(
        "crossed waves pressed flat, periodic",
        "Johnson, Greenwood & Higginson 1985",
        (
            Quantity("amplitude of pressure", "Pa", 1e-6, 1e-6),
            Quantity("contact area", "m2", 1e-9, 1e-9),
        ),
        (16, 32, 64),
        _flat,
    ),
)
