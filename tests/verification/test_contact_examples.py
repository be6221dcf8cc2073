"""Contacts at rest among the examples of CONTACT, whose published results stand beside ours.

E. A. H. Vollebregt, CONTACT (repository eve70a/CONTACT, commit d431cdb, 2025): `cattaneo.ref_out`
and the first case of `catt_to_cart.ref_out`, on the same cells, and points of the second case of
`subsurf.ref_subs`. Its lengths are in mm, its forces
in N, its slip that of one step. Signs of forces are those of the other body.
"""

from __future__ import annotations

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.mechanics.halfspace.stress import Stress
from viscontact.mechanics.halfspace.stress_response import HalfSpaceShearStress, HalfSpaceStress

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


def pulled(
    *, modulus: float, ratio: float, curvature: float, force: float, part: float, mu: float,
    grid: vc.Grid,
) -> vc.ContactState:  # fmt: skip
    """Two equal bodies [Pa] of gap curvature · r² [1/m], pressed [N], then pulled along x."""
    radius, body = 0.5 / curvature, vc.Material(vc.Elastic(modulus), ratio)
    (state,) = vc.march(
        vc.Paraboloid(radius, radius),
        body,
        vc.step(force),
        grid,
        [1.0],
        indenter_material=body,
        friction=mu,
        tangential=vc.TangentialHistory([1.0], force_x=part * mu * force),
        tolerance=1e-8,
    )
    return state


@pytest.fixture(scope="module")
def polyethylene() -> vc.ContactState:
    """Balls of shear modulus 200 MPa and radius 50 mm: `cattaneo.inp`, second case."""
    return pulled(
        modulus=200e6,
        ratio=0.42,
        curvature=10.0,
        force=9.1954,
        part=0.875,
        mu=0.4,
        grid=vc.Grid((19, 19), (19 * 0.13333e-3, 19 * 0.13333e-3)),
    )


def test_cattaneo_has_the_totals_of_contact(polyethylene):
    """To its four digits; ours are 19.9809 µm, 4.39303 MPa, 8.15489 µm, 2.7496 µJ."""
    state = polyethylene
    assert state.approach == close_to(1.998e-5, rel=3e-4)
    assert state.peak_pressure == close_to(4.393e6, rel=1.2e-4)
    assert state.tangential_displacement_x == close_to(8.155e-6, rel=1e-4)
    assert state.friction_heat == close_to(2.750e-6, rel=3e-4)


def test_cattaneo_sticks_and_slips_in_the_cells_of_contact(polyethylene):
    """45 cells stick and 132 slip; a quarter of its picture, from the middle to +x and +y."""
    quarter = polyethylene.slip_state[9:17, 9:17]
    rows = [
        "****SSSS",
        "****SSSS",
        "****SSSS",
        "***SSSS.",
        "SSSSSSS.",
        "SSSSSS..",
        "SSSSS...",
        "SSS.....",
    ]
    drawn = ["".join(".*S"[cell] for cell in quarter[:, row]) for row in range(8)]
    assert drawn == rows
    assert np.count_nonzero(polyethylene.slip_state == 1) == 45
    assert np.count_nonzero(polyethylene.slip_state == 2) == 132


@pytest.mark.parametrize(
    ("x", "y", "pressure", "traction", "angle", "slip"),
    [
        (-0.2667, -0.9333, 0.901, 0.361, 176.4, 3.47e-3),
        (0.0, -0.8, 2.65, 1.06, 180.0, 1.81e-3),
        (-0.6667, -0.6667, 1.36, 0.545, 172.2, 2.77e-3),
        (-0.4, -0.5334, 3.28, 1.31, 177.4, 0.665e-3),
    ],
)
def test_cattaneo_has_the_cells_of_contact(polyethylene, x, y, pressure, traction, angle, slip):
    """To the three digits that are printed. The force of its input has the other direction."""
    i, j = round(x / 0.13333) + 9, round(y / 0.13333) + 9
    state = polyethylene
    q = -complex(state.traction_x[i, j], state.traction_y[i, j])
    assert state.pressure[i, j] == close_to(pressure * 1e6, rel=4e-3)
    assert abs(q) == close_to(traction * 1e6, rel=4e-3)
    assert abs(np.angle(q, deg=True)) == close_to(angle, abs=0.06)
    assert np.hypot(state.slip_x[i, j], state.slip_y[i, j]) == close_to(slip * 1e-3, rel=4e-3)


def test_the_first_step_from_cattaneo_to_carter():
    """Shear modulus 1 MPa, Poisson's ratio 0.28, part 0.657 of what friction carries."""
    state = pulled(
        modulus=1e6,
        ratio=0.28,
        curvature=2.963,
        force=0.4705,
        part=0.657,
        mu=0.4013,
        grid=vc.Grid((34, 33), (8.5e-3, 8.25e-3), centre=(0.125e-3, 0.0)),
    )
    assert state.approach == close_to(7.258e-5, rel=1e-4)
    assert state.peak_pressure == close_to(1.834e4, rel=4e-4)
    assert state.tangential_displacement_x == close_to(1.774e-5, rel=4e-4)
    assert state.friction_heat == close_to(1.261e-7, rel=1e-3)
    counts = [np.count_nonzero(state.slip_state == each) for each in (1, 2)]
    assert counts == [305, 316]


#: Forces of `spence35.inp`: (k/45)³ as it is printed there.
SPENCE = [0.000011, 0.000088, 0.000296, 0.000702, 0.001372, 0.002370]


def pressed_in_stages(forces: list[float]) -> list[vc.ContactState]:
    """A body of shear modulus 0.5 MPa and ν = 0 under one of 10^5 MPa, with μ = 0.2986."""
    times, radius = np.arange(len(forces)) * 1.0, 0.5e-3 / 0.004116
    return list(
        vc.march(
            vc.Paraboloid(radius, radius),
            vc.Material(vc.Elastic(0.5e6), 0.0),
            vc.ForceHistory(times, forces),
            vc.Grid((45, 45), (9e-3, 9e-3)),
            times,
            indenter_material=vc.Material(vc.Elastic(1e11), 0.0),
            friction=0.2986,
            tangential=vc.tangential_step(displacement_x=0.0, displacement_y=0.0),
        )
    )


def test_spence_in_its_first_stages_has_the_numbers_of_contact():
    """Dissimilar bodies, whose pressure and tractions are coupled: case 6 of 35."""
    state = pressed_in_stages(SPENCE)[-1]
    assert state.approach == close_to(2.901e-6, rel=3e-4)
    assert state.peak_pressure == close_to(3.941e3, rel=3e-4)
    assert np.count_nonzero(state.slip_state == 1) == 5
    assert np.count_nonzero(state.slip_state == 2) == 24


@pytest.mark.slow
def test_spence_in_all_stages_has_the_numbers_of_contact():
    """Case 35: 225 cells stick; of 921 cells in contact there, four at the rim are open here."""
    forces = SPENCE + [round((k / 45) ** 3, 6) for k in range(7, 36)]
    states = pressed_in_stages(forces)
    for case, approach, peak in ((18, 26.10, 12.20), (35, 98.74, 23.92)):
        assert states[case - 1].approach == close_to(approach * 1e-6, rel=2e-4)
        assert states[case - 1].peak_pressure == close_to(peak * 1e3, rel=4e-4)
    middle, last = states[17], states[34]
    assert np.count_nonzero(middle.slip_state == 1) == 61
    assert np.count_nonzero(middle.slip_state == 2) == 180
    assert np.count_nonzero(last.slip_state == 1) == 225
    assert np.count_nonzero(last.slip_state == 2) == close_to(696, abs=4)


#: Places [m], components xx, yy, zz, yz, xz, xy and von Mises stress [Pa] of `subsurf.ref_subs`.
SUBSURF = [
    (
        (1e-05, 1e-05, 0.1),
        (-0.555944, -0.5561, -0.994287, 1.5717e-05, -0.736402, 0.00010784),
        1.34868,
    ),
    (
        (1e-05, 1e-05, 0.5),
        (-0.076184, -0.076223, -0.700842, 9.3105e-05, -0.149363, 3.1474e-05),
        0.676093,
    ),
    (
        (1e-05, 1e-05, 1.25),
        (0.0077195, 0.0077168, -0.240934, 2.8829e-05, -0.011637, 2.688e-06),
        0.249467,
    ),
    ((-0.4, -0.4, 0.2), (0.216171, -0.107766, -0.436917, 0.083638, -0.091959, 0.14001), 0.651968),
    ((0.4, 0.1, 0.1), (-1.21476, -0.606507, -1.05697, -0.016678, -0.649805, -0.044102), 1.25391),
    ((-0.6, 0, 0.1), (0.725294, -0.015388, 0.062416, -1.4267e-05, -0.175973, 0.00010461), 0.768072),
    ((1, -0.8, 0.4), (-0.152588, -0.069867, -0.03745, 0.056402, -0.075732, 0.091827), 0.250243),
    (
        (-2, 3, 1.667),
        (0.0012045, 0.00038138, 0.00039145, 0.0006872, -0.00052571, -0.0035749),
        0.006423,
    ),
    (
        (5, -1, 2.5),
        (-0.012827, -4.8195e-05, -0.0038435, 0.0015176, -0.0076052, 0.0024573),
        0.018104,
    ),
]


@pytest.mark.parametrize(("place", "components", "von_mises"), SUBSURF)
def test_subsurf_has_the_stresses_of_contact(place, components, von_mises):
    """Unit square under 1 Pa and a traction of 0.999 Pa, ν = 0.28: all digits that it prints.

    Numbers below 0.1 have five. At all of its 6630 points ours differ by 5e-6 Pa at most.
    """
    x, y, depth = place
    edges = np.array([x + 0.4999, x - 0.5001]), np.array([y + 0.4998, y - 0.5002])
    pressed, sheared = (
        body.coefficients(*edges, depth)[:, 0, 0]
        for body in (HalfSpaceStress(0.28), HalfSpaceShearStress(0.28, axis=0))
    )
    found = Stress(pressed + 0.999 * sheared)
    assert found.components == close_to(np.array(components), rel=5e-5, abs=5e-7)
    assert float(found.von_mises) == close_to(von_mises, rel=5e-5)
