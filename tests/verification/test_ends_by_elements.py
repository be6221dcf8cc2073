"""Line load between two free ends against finite elements of sections of the body, wave by wave."""

from __future__ import annotations

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from verification.section_contact import Section, line_load
from viscontact.backend.arrays import Floats

#: Half width of the contact far from the ends, length of body and cylinder, its radius [m], and
#: the reduced modulus [Pa]; the load per length is that of this half width.
HALF_WIDTH, LENGTH, RADIUS, MODULUS = 0.25e-3, 4e-3, 10e-3, 1e9
LINE = np.pi * HALF_WIDTH**2 * MODULUS / (4 * RADIUS)


def _by_elements(ratio: float, rows: int, columns: int, width: float, waves: int) -> Floats:
    """Load of rows over its mean, from the end to the middle."""
    half = LENGTH / 2
    section = Section(ratio, 1.0, rows)
    y = (np.arange(columns // 2) + 0.5) * width / columns
    # Lengths are in half lengths of the body, stresses in shear moduli.
    gap, level = y**2 / (2 * RADIUS) / half, LINE / width / (MODULUS * (1 - ratio) / 2)
    return line_load(section, rows, columns, width / half, gap, waves, level)


def _by_waves(ratio: float, rows: int, columns: int, width: float) -> Floats:
    """The same by the package."""
    law = vc.Elastic.from_uniaxial(MODULUS * (1 - ratio**2), poisson_ratio=ratio)
    beyond = LENGTH * (1 + 2 / rows)
    found = vc.simulate(
        vc.Roller(RADIUS, LENGTH / 2),
        vc.Body(vc.Material(law, ratio), LENGTH),
        vc.step(LINE * LENGTH),
        vc.Grid((2 * rows + 4, columns), (beyond, width), periodic=(False, True)),
        [0.0],
        tolerance=1e-7,
        errors=False,
    )
    return np.asarray(found.line_load[0].values[2 : rows + 2] / LINE)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # no datum
@pytest.mark.parametrize(
    ("ratio", "rows", "columns", "periods", "waves"),
    [
        (0.3, 20, 24, 8, 12),
        pytest.param(0.3, 40, 96, 24, 40, marks=pytest.mark.slow),
        pytest.param(0.45, 40, 96, 24, 40, marks=pytest.mark.slow),
    ],
)
def test_the_line_load_between_free_ends_is_that_of_finite_elements(
    ratio: float, rows: int, columns: int, periods: int, waves: int
) -> None:
    # Periods of 8 and of 24 half widths, at which the load falls to 0.95 and to 0.89 of its mean
    # half a half width from the end.
    width = periods * HALF_WIDTH
    expected = _by_elements(ratio, rows, columns, width, waves)
    found = _by_waves(ratio, rows, columns, width)
    # The load of two rows at the end, where the elements have means over rows and the package the
    # displacement of their middle, differs by up to a hundredth, of both signs.
    assert found[2:] == close_to(expected[2:], rel=2.5e-3)
    assert found[4:] == close_to(expected[4:], rel=1e-3)
    assert found[:2].sum() == close_to(expected[:2].sum(), rel=1e-2)
    assert expected[2] < 1 < expected[-1]
