"""Events of load programs against exact solutions."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

import viscontact as vc

RADIUS, FORCE, RATE = 0.01, 0.05, 1e-4
BALL = vc.Paraboloid(RADIUS, RADIUS)
LAWS = {"zener": vc.Zener(1e6, 1e6, 1e6), "maxwell": vc.Maxwell(1e6, 5e5)}
PROGRAM = vc.LoadProgram(
    "move at 0.1 mm/s until force reaches 50 mN; retract at 0.2 mm/s until contact is lost"
)
pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


def exact_events(law):
    """Instants of the force under a rate (Lee and Radok 1960), and of lost contact (Ting 1966)."""

    def modulus(t):
        return 4 * float(law.relaxation(t))  # contact modulus, incompressible

    def force(t):
        """4/3 sqrt(R) ∫ M(t - t') d(v t')^(3/2), with t' = u²."""
        grown = quad(lambda u: modulus(t - u * u) * 3 * u * u, 0, np.sqrt(t))[0]
        return 4 / 3 * np.sqrt(RADIUS) * RATE**1.5 * grown

    reached = brentq(lambda t: force(t) - FORCE, 1e-3, 8)

    def remains(t):
        """∫ M(t - t') dw(t') over the whole past, 0 when contact is lost."""
        rise = quad(lambda s: modulus(t - s), 0, reached)[0]
        return rise - 2 * quad(lambda s: modulus(t - s), reached, t)[0]

    return reached, brentq(remains, reached, 3 * reached)


def run(law, cells, steps, program=PROGRAM, end=0.5):
    material, grid = vc.Material(law, 0.5), vc.Grid((cells, cells), (1.8e-3, 1.8e-3))
    times = vc.uniform_times(end, steps)
    return vc.simulate(BALL, material, program, grid, times, errors=False, fields="none")


def events_of(ds):
    """Instants of the two events: that of the largest approach, and the end."""
    return float(ds.time[int(ds.approach.values.argmax())]), float(ds.time[-1])


@pytest.mark.parametrize("name", LAWS)
def test_events_are_where_lee_radok_and_ting_have_them(name):
    ds = run(LAWS[name], 129, 80)
    assert np.allclose(events_of(ds), exact_events(LAWS[name]), rtol=1e-4, atol=0)
    assert ds.force[-1] == 0
    assert ds.force[int(ds.approach.values.argmax())] == pytest.approx(FORCE, rel=1e-6)
    assert ds.attrs["events"].count("\n") == 1


def test_events_are_of_second_order_in_the_steps():
    # The cells' error is the same; that of the steps falls to a quarter each time.
    coarse, middle, fine = (np.array(events_of(run(LAWS["zener"], 33, n))) for n in (40, 80, 160))
    orders = np.log2((coarse - middle) / (middle - fine))
    assert (orders > 1.6).all()


def test_height_then_force_are_held():
    program = vc.LoadProgram(
        "move at 0.1 mm/s until force reaches 50 mN; hold height for 0.1 s; hold force for 0.1 s"
    )
    ds = run(LAWS["zener"], 33, 50, program)
    begin = float(ds.time[-1]) - 0.2
    height = ds.sel(time=slice(begin - 1e-9, begin + 0.1 + 1e-9))
    force = ds.sel(time=slice(begin + 0.1 - 1e-9, None))
    assert np.ptp(height.approach.values) <= 1e-12 * height.approach[0]
    assert height.force[-1] < 0.97 * height.force[0]
    assert np.allclose(force.force, force.force[0], rtol=1e-5)
    assert force.approach[-1] > 1.001 * force.approach[0]
    # The force at the end of the hold is that of the relaxed body, and stays there.
    assert force.force[0] == pytest.approx(float(height.force[-1]), rel=1e-5)


def test_a_stop_ends_the_run():
    area = 3e-7
    program = vc.LoadProgram("move at 0.1 mm/s for 5 s; stop when contact_area exceeds 0.3 mm^2")
    ds = run(LAWS["zener"], 33, 50, program)
    assert ds.contact_area[-1] == pytest.approx(area, rel=1e-6)
    assert (ds.contact_area[:-1] < area).all()
    assert "the run ends" in ds.attrs["events"]


def test_what_never_happens_is_said():
    program = vc.LoadProgram("move at 0.1 mm/s until force reaches 5 kN")
    with pytest.raises(
        ValueError, match="segment 1 lasts until force reaches 5 kN, which does not"
    ):
        run(LAWS["zener"], 33, 10, program, end=0.1)


def test_what_the_run_would_choose_is_refused():
    material, grid = vc.Material(LAWS["zener"], 0.5), vc.Grid((33, 33), (1.8e-3, 1.8e-3))
    with pytest.raises(ValueError, match="grid"):
        vc.simulate(BALL, material, PROGRAM, times=[0.0, 1.0])
    with pytest.raises(ValueError, match="needs given instants"):
        vc.simulate(BALL, material, PROGRAM, grid, vc.adaptive_times(1.0, 1e-3))
    with pytest.raises(ValueError, match="LoadProgram is for simulate"):
        vc.steady(BALL, material, PROGRAM, 1.0, rolling=False)
