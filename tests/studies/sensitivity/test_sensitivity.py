"""Elasticities against closed forms."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.studies.sensitivity.cases import HERTZ, deviations, written

import viscontact as vc
from closeness import close_to

#: d ln E* / d ln nu of 1 / E* = (1 - nu^2) / E.
OF_RATIO = 2 * 0.4**2 / (1 - 0.4**2)

LINE = """
indenter: {shape: paraboloid, radius_x: infinite, radius_y: 10 mm}
material: {data: uniaxial, law: elastic, youngs_modulus: 10 MPa, poisson_ratio: 0.4}
load: {kind: step, force: 10 N}
time: {end: 1 s, steps: 1}
grid: {shape: [1, 120], size: [10 mm, 9 mm], periodic: [true, false]}
"""

CREEPING = """
indenter: {shape: paraboloid, radius_x: 10 mm, radius_y: 10 mm}
material:
  {law: power-law, compliance: 0.5 / MPa, exponent: 0.3, reference_time: 2 s, data: deviatoric,
   poisson_ratio: 0.5}
load: {kind: ramp, force: 1 N, duration: 10 s}
time: {end: 6 s, steps: 24}
grid: {shape: [64, 64], size: [4 mm, 4 mm]}
"""


def test_a_hertzian_contact_has_the_exponents_of_its_closed_form(tmp_path: Path) -> None:
    # Johnson (1985), eqs. 4.22 to 4.24. Without coarser cells, so 5 runs and an error of the step.
    path = written(tmp_path, HERTZ + "output: {errors: false}\n")
    found = vc.sensitivity(path, ["contact_area", "approach"], change=["load.force"], workers=1)
    elasticities = found.table.elasticity.sel(input="load.force")
    assert elasticities.values == close_to(2 / 3, abs=0.01)
    one = found.table.sel(output="approach", input="load.force")
    assert float(one.derivative) == close_to(float(one.elasticity * one.value / 1.0))
    assert float(one.derivative_error) == close_to(float(one.elasticity_error * one.value / 1.0))
    assert found.runs == 5
    assert "approach: its error is not known" in found.notes[1]


@pytest.mark.slow
def test_all_inputs_of_a_hertzian_contact_are_within_their_errors(tmp_path: Path) -> None:
    found = vc.sensitivity(
        written(tmp_path, HERTZ), "peak_pressure,contact_area,approach,contact_width", workers=2
    )
    radii = ("indenter.radius_x", "indenter.radius_y")
    # Exponents of force, modulus and the radius of a paraboloid of revolution, in halves of it.
    powers = {"peak_pressure": (1 / 3, 2 / 3, -2 / 3), "contact_area": (2 / 3, -2 / 3, 2 / 3)}
    powers["approach"] = (2 / 3, -2 / 3, -1 / 3)
    wanted: dict[tuple[str, str], float] = {}
    for name, (force, modulus, radius) in powers.items():
        wanted[name, "load.force"] = force
        wanted[name, "material.youngs_modulus"] = modulus
        wanted[name, "material.poisson_ratio"] = modulus * OF_RATIO
        # By symmetry each of the two radii has half of the exponent of the common one.
        wanted |= {(name, key): radius / 2 for key in radii}
    assert not deviations(found, wanted)


def test_a_line_contact_on_a_grid_of_its_own_keeps_its_load_per_length(tmp_path: Path) -> None:
    # Johnson (1985), eq. 4.45, of 10 N on a period of 1 m.
    path = written(tmp_path, LINE[: LINE.index("grid")] + "grid: {tolerance: 2 %}\n")
    found = vc.sensitivity(path, "peak_pressure", change=["load.force"], workers=1)
    one = found.table.sel(output="peak_pressure", input="load.force")
    peak = (10.0 * 10e6 / (1 - 0.4**2) / (np.pi * 0.01)) ** 0.5
    assert float(one.value) == close_to(peak, rel=0.02)
    assert float(one.elasticity) == close_to(1 / 2, abs=0.01)


@pytest.mark.slow
def test_a_line_contact_follows_the_square_root_of_its_load(tmp_path: Path) -> None:
    # Johnson (1985), eqs. 4.43 to 4.45.
    found = vc.sensitivity(written(tmp_path, LINE), "peak_pressure,contact_width", workers=2)
    wanted = {
        ("peak_pressure", "load.force"): 1 / 2,
        ("peak_pressure", "indenter.radius_y"): -1 / 2,
        ("peak_pressure", "material.youngs_modulus"): 1 / 2,
        ("peak_pressure", "material.poisson_ratio"): OF_RATIO / 2,
        ("contact_width", "load.force"): 1 / 2,
        ("contact_width", "indenter.radius_y"): 1 / 2,
        ("contact_width", "material.youngs_modulus"): -1 / 2,
    }
    assert not deviations(found, wanted)


@pytest.mark.slow
def test_a_power_law_under_a_ramp_has_the_exponents_of_lee_and_radok(tmp_path: Path) -> None:
    # Lee and Radok (1960): a^3 is proportional to the integral of Phi(t - s) dF(s), here
    # C F/T t^(1 + n) / (t0^n (1 + n)), and the approach to a^2.
    found = vc.sensitivity(
        written(tmp_path, CREEPING), "approach,contact_area", at="end", workers=2
    )
    n, time, reference = 0.3, 6.0, 2.0
    of_exponent = 2 / 3 * n * (np.log(time / reference) - 1 / (1 + n))
    wanted: dict[tuple[str, str], float] = {}
    for name in ("approach", "contact_area"):
        wanted |= {
            (name, "material.compliance"): 2 / 3,
            (name, "load.force"): 2 / 3,
            (name, "load.duration"): -2 / 3,
            (name, "material.reference_time"): -2 / 3 * n,
            (name, "material.exponent"): of_exponent,
        }
    assert not deviations(found, wanted)


REFUSED = {
    "output": ({"of": "peak_presure"}, "of: 'peak_presure' is no scalar of a result; did you mean"),
    "no output": ({"of": " ,"}, "of: name a scalar"),
    "key": ({"change": ["load.farce"]}, "change: load.farce: the case has no such number"),
    "twice": ({"change": ["load.force"] * 2}, "change: load.force: is given twice"),
    "step": ({"step": 0.6}, "step: must be 0.5 at most"),
    "instant": ({"at": "start"}, "at: must be 'worst', 'end' or a time"),
    "range": ({"scatter": {"load.force": ("2 N", "1 N")}}, "the lower bound comes first"),
    "scattered key": ({"scatter": {"load.farce": ("1 N", "2 N")}}, "farce"),
    "twice scattered": (
        {"scatter": {"load.force": ("1 N", "2 N")}, "settings": {"load.force": "1 N"}},
        "load.force: is given twice, in scatter or settings",
    ),
    "adaptive": (
        {"settings": {"time": "{end: 1 s, spacing: adaptive}"}},
        "time.spacing: adaptive steps differ from run to run",
    ),
    "case": ({"settings": {"load.force": "1 mm"}}, "load.force: cannot read '1 mm' as a force"),
}


@pytest.mark.parametrize(("given", "message"), REFUSED.values(), ids=REFUSED.keys())
def test_an_argument_that_does_not_fit_is_refused(
    tmp_path: Path, given: dict[str, object], message: str
) -> None:
    arguments = {"of": "approach"} | given
    with pytest.raises(ValueError, match=r"\w") as refusal:
        vc.sensitivity(written(tmp_path, HERTZ), **arguments)  # type: ignore[arg-type]
    assert message in str(refusal.value)
    assert "--set" not in str(refusal.value)
