"""Remedies for singular pressure: each names keys that a case file has, and they help."""

import math
import re

import numpy as np
import pytest

import viscontact as vc
from viscontact.bodies.indenters.rounding import rounding_remedy
from viscontact.case.indenters import more_shapes, profiles, shapes
from viscontact.case.indenters.height_maps import HeightMap

L = 5e-3
LINE = ([0.0, 4e-3, 5e-3], [0.0, 0.0, 1e-5])


def roller(profile, **arguments):
    return vc.Roller(L, L, profile=profile, **arguments)


#: Bodies, and the sections of a case file in which the keys of their remedies lie.
BODIES = {
    "cone": (vc.Cone(1.4), (more_shapes.Revolved,)),
    "round punch": (vc.FlatPunch(L), (more_shapes.Revolved,)),
    "wedge": (vc.Wedge(1.4), (more_shapes.Swept,)),
    "linear section": (vc.Swept(*LINE, None, "linear"), (more_shapes.Swept,)),
    "map": (vc.HeightMap([0, 1], [0, 1], np.zeros((2, 2))), (HeightMap,)),
    "roller": (vc.Roller(L, L), (shapes.Roller, profiles.Chamfer)),
    "full": (roller("full", crown_radius=1.0), (shapes.Roller,)),
    "partial": (vc.Roller(L, L, 1.0), (shapes.Roller, profiles.Partial)),
    "two radii": (
        roller("two-radii", crown_radius=1.0, crown_length=1e-3, end_radius=0.1),
        (profiles.TwoRadii,),
    ),
    "chamfer": (roller("chamfer", angle=0.05, length=1e-3), (profiles.Chamfer,)),
    "logarithmic": (
        roller("logarithmic", amplitude=1e-6, end_drop=1e-5),
        (profiles.Logarithmic, profiles.JohnsGohar),
    ),
    "table": (vc.Roller(L, L, profile=vc.TabulatedProfile(*LINE)), (profiles.TabulatedLine,)),
}
#: Values of the keys `shape` and `kind` that remedies name.
KINDS = {"revolved", "swept", "height-map", "chamfer"}


@pytest.mark.parametrize("name", BODIES)
def test_remedy_names_keys_of_the_case_file(name):
    body, sections = BODIES[name]
    known = {key for section in sections for key in section.model_fields}
    quoted = re.findall(r"'(\w+)(?:: ([\w-]+))?'", rounding_remedy(body))
    assert quoted
    for key, value in quoted:
        assert key in known
        assert value in KINDS if key in ("shape", "kind") else key in known


def test_remedy_of_a_moved_body_and_of_a_sum_is_that_of_the_sharp_one():
    cone = vc.Cone(1.4)
    for body in (cone.rotated(0.1).shifted(1e-3), vc.Sphere(0.01) + cone):
        assert rounding_remedy(body) == rounding_remedy(cone)


def test_body_without_such_keys_has_a_remedy_in_words():
    assert "radius that it has in reality" in rounding_remedy(vc.Pyramid(1.2, 4))
    assert "shorter cells" in rounding_remedy(roller("logarithmic", amplitude=1e-6))


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
@pytest.mark.parametrize(
    ("sharp", "rounded"),
    [
        pytest.param(
            vc.Roller(L, 4e-3), vc.Roller(L, 4e-3, crown_radius=0.05), marks=pytest.mark.slow
        ),
        pytest.param(
            roller("chamfer", angle=0.02, length=1e-3),
            roller("chamfer", angle=0.02, length=1e-3, corner_radius=0.05),
            marks=pytest.mark.slow,
        ),
        (vc.Cone(math.radians(88)), vc.Revolved([0, 1e-3, 4e-3], [0, 2e-5, 1.4e-4])),
    ],
    ids=["crown_radius", "corner_radius", "revolved"],
)
def test_remedy_bounds_the_peak_pressure(sharp, rounded):
    """On automatic grids: infinite bars before, a few per cent after."""
    rubber = vc.Material(vc.Elastic(1e6), 0.5)
    bars = []
    for body in (sharp, rounded):
        ds = vc.simulate(body, rubber, vc.step(0.3), None, [0.0], fields="none")
        bars.append(float(ds.peak_pressure_error[0] / ds.peak_pressure[0]))
    assert bars[0] == math.inf
    assert bars[1] < 0.1
