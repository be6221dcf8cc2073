"""What users rely on: public names, and the arguments that they take."""

from __future__ import annotations

import inspect
import json
import tempfile
from pathlib import Path
from typing import Any

import pytest

import viscontact as vc
from project.promised_run import BALL, CASE, GRID, LOAD, RUBBER

# More arguments may follow behind: adding is free.
SIGNATURES = {
    "Sphere": "(radius)",
    "Paraboloid": "(radius_x, radius_y)",
    "Cone": "(half_angle)",
    "FlatPunch": "(radius=None, *, half_length=None, half_width=None)",
    "Roller": "(radius, half_length, crown_radius=None, profile=None)",
    "HeightMap": "(x, y, height)",
    "Elastic": "(shear_modulus)",
    "Maxwell": "(shear_modulus, viscosity)",
    "Zener": "(shear_modulus, delayed_modulus, viscosity)",
    "Burgers": "(shear_modulus, viscosity, delayed_modulus, delayed_viscosity)",
    "CreepSeries": "(instant, amplitudes, times, fluidity=0.0)",
    "RelaxationSeries": "(equilibrium, moduli, times)",
    "PowerLaw": "(compliance, exponent, reference_time, instant=0.0)",
    "FractionalMaxwell": "(shear_modulus, time, exponent, second_exponent=0.0)",
    "FractionalZener": "(shear_modulus, equilibrium_modulus, time, exponent)",
    "TabulatedCreep": "(times, compliance, *, before='first', beyond='slope')",
    "TabulatedRelaxation": "(times, modulus, *, before='first', beyond='slope')",
    "Material": "(law, poisson_ratio=None, *, bulk_modulus=None)",
    "ForceHistory": "(times, force, eccentricity_x=0.0, eccentricity_y=0.0, "
    "tilt_x=None, tilt_y=None)",
    "step": "(force=None, *, approach=None, eccentricity_x=0.0, eccentricity_y=0.0, "
    "tilt_x=None, tilt_y=None)",
    "ramp": "(force=None, duration=None, *, approach=None, eccentricity_x=0.0, "
    "eccentricity_y=0.0, tilt_x=None, tilt_y=None)",
    "triangle": "(force=None, rise=None, fall=None, *, approach=None, eccentricity_x=0.0, "
    "eccentricity_y=0.0, tilt_x=None, tilt_y=None)",
    "Grid": "(shape, size)",
    "auto_grid": "(indenter, material, load, tolerance=0.01)",
    "uniform_times": "(end, n)",
    "log_times": "(first, end, n)",
    **dict.fromkeys(
        ("simulate", "march"),
        "(indenter, material, load, grid=None, times=None, *, indenter_material=None, "
        "tolerance=1e-06, fields='all', threads=1, progress=None)",
    ),
    "rolling_temperature": "(curve, *, cooling, ambient, area=None, speed=None, conductivity=None, "
    "core_temperature=None, heat_capacity=None, density=None)",
    "leakage": "(ds, *, viscosity, pressure_difference=None, along='x', ends=None, length=None, "
    "width=None, gas=None, fields='none')",
    "under_pressure": "(pressure, material, grid=None, times=None)",
    "save": "(ds, path)",
    "open_results": "(path)",
}


def _bare_signature(thing: Any) -> str:
    """Names and defaults of the arguments, without their types."""
    signature = inspect.signature(thing)
    bare = [each.replace(annotation=each.empty) for each in signature.parameters.values()]
    return str(signature.replace(parameters=bare, return_annotation=signature.empty))


@pytest.mark.parametrize("name", SIGNATURES)
def test_name_is_public_and_takes_the_promised_arguments(name: str) -> None:
    assert name in vc.__all__
    assert _bare_signature(getattr(vc, name)).startswith(SIGNATURES[name].removesuffix(")"))


def test_package_says_its_version_and_offers_the_exact_solutions() -> None:
    assert vc.__version__.count(".") == 2
    assert vc.reference.hertz_sphere
    for error in (vc.ConvergenceError, vc.DomainError):
        assert error("why").partial is None
    assert issubclass(vc.AccuracyWarning, UserWarning)
    assert (vc.Outcome.CONVERGED, vc.Outcome.NO_CONTACT, vc.Outcome.NOT_CONVERGED) == (0, 1, 2)


PROFILES: dict[str, Any] = {
    "cylindrical": {"profile": "cylindrical"},
    "full": {"profile": "full", "crown_radius": 1.0},
    "partial": {"profile": "partial", "crown_radius": 1.0},
    "logarithmic": {"profile": "logarithmic", "amplitude": 1e-6},
    "chamfer": {"profile": "chamfer", "angle": 0.5, "length": 1e-3},
    "table of (x, drop)": {"profile": [(0.0, 0.0), (0.01, 1e-6)]},
}


@pytest.mark.parametrize("arguments", PROFILES.values(), ids=PROFILES)
def test_roller_takes_each_named_profile_with_its_own_arguments(arguments: Any) -> None:
    roller = vc.Roller(0.005, 0.01, **arguments)
    assert float(roller.gap(0.0, 0.0)) == 0.0
    assert float(roller.gap(0.001, 0.001)) > 0.0


def test_objects_are_frozen() -> None:
    for given in (BALL, vc.Elastic(1.0), RUBBER, GRID, LOAD):
        with pytest.raises(AttributeError):
            given.radius = 1.0


def test_functions_for_many_runs_have_their_arguments() -> None:
    names = {"executor", "client", "directory", "workers", "progress", "return_exceptions"}
    assert set(inspect.signature(vc.simulate_many).parameters) >= {"runs", *names}
    assert next(iter(inspect.signature(vc.open_many).parameters)) == "directory"
    case = {"load.force": ["1 N", "2 N"]}
    with tempfile.TemporaryDirectory() as place:
        (Path(place) / "ball.yaml").write_text(json.dumps(CASE), encoding="utf-8")
        assert len(list(vc.vary(Path(place) / "ball.yaml", case))) == 2
