"""Terms of surfaces: which bodies have one, and what they add up to."""

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE
from viscontact.mechanics.problem.surface import surface_of

Q = np.geomspace(1.0, 1e6, 25)
RUBBER = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.49)
STIFFER = vc.Material(vc.Zener(3e6, 3e6, 3e6), poisson_ratio=0.3)
STEEL = vc.Material(vc.Elastic(80e9), poisson_ratio=0.3)
BRONZE = vc.Material(vc.Elastic(40e9), bulk_modulus=110e9)
GEL = vc.Material(vc.PowerLaw(1e-4, 0.3, 1.0, instant=1e-6), poisson_ratio=0.5)


def displacement(surface, time):
    """J L of a wave of each wave number, of a step of pressure at a time [1/Pa]."""
    return sum(term.compliance(time) * term.response.ratio(Q) for term in surface.terms)


def test_bodies_without_layers_are_one_half_space():
    surface = surface_of([RUBBER, STEEL])
    assert [term.response for term in surface.terms] == [HALF_SPACE]
    both = RUBBER.contact_compliance() + STEEL.contact_compliance()
    assert surface.compliance(2.0) == close_to(both(2.0), rel=1e-15)
    assert surface.splitting_error == 0


@pytest.mark.parametrize(
    "body",
    [
        vc.Layered([vc.Layer(1e-3, RUBBER)], base="rigid"),
        vc.Layered([vc.Layer(1e-3, GEL)], base="rigid", bonded=False),
        vc.Layered([vc.Layer(1e-3, RUBBER), vc.Layer(2e-3, STIFFER)], base=RUBBER),
        vc.Layered([vc.Layer(1e-3, STEEL), vc.Layer(2e-3, BRONZE)], base=BRONZE),
    ],
)
def test_layers_that_creep_alike_are_one_exact_term(body):
    surface = surface_of([body])
    assert len(surface.terms) == 1
    assert surface.splitting_error == 0
    # As an elastic body of each material's compliance at that time (Lee 1955).
    for time in (0.0, 0.7):
        assert displacement(surface, time) == close_to(elastic(body, time), rel=1e-12)


def elastic(body, time):
    """J L of the elastic body with the compliances of its materials at one time [1/Pa]."""
    held = vc.Layered(
        [vc.Layer(layer.thickness, frozen(layer.material, time)) for layer in body.layers],
        body.base if isinstance(body.base, str) else frozen(body.base, time),
        body.bonded,
    )
    return displacement(surface_of([held]), 0.0)


def frozen(material, time):
    law = vc.Elastic(0.5 / material.law(time))
    return vc.Material(law, material.poisson_ratio, bulk_modulus=material.bulk_modulus)


def test_equal_layers_on_the_same_base_are_a_half_space():
    body = vc.Layered([vc.Layer(1e-3, RUBBER), vc.Layer(1e-3, RUBBER)], base=RUBBER)
    half_space = surface_of([RUBBER])
    found = displacement(surface_of([body]), 0.7)
    assert found == close_to(displacement(half_space, 0.7), rel=1e-12)


def test_compliances_of_both_bodies_add():
    cover = vc.Layered([vc.Layer(1e-3, RUBBER)], base="rigid")
    ball = RUBBER.contact_compliance()
    # Of a material that creeps as the cover does, one term; of another, two.
    alike, other = surface_of([cover, STIFFER]), surface_of([cover, STEEL])
    assert [len(each.terms) for each in (alike, other)] == [1, 2]
    for surface, mate in ((alike, STIFFER), (other, STEEL)):
        both = displacement(surface_of([cover]), 0.7) + mate.contact_compliance()(0.7)
        assert displacement(surface, 0.7) == close_to(both, rel=1e-12)
        short = ball(0.7) + mate.contact_compliance()(0.7)
        assert surface.compliance(0.7) == close_to(short, rel=1e-12)


def test_the_elastic_body_at_a_time_has_all_terms():
    body = vc.Layered([vc.Layer(1e-3, RUBBER)], base=STEEL)
    surface = surface_of([body, STEEL])
    for time in (0.0, 0.7):
        at_time = surface.response_at(time).ratio(Q) * surface.compliance(time)
        assert at_time == close_to(displacement(surface, time), rel=1e-9)


def test_the_creep_function_of_a_cover_is_that_of_its_law():
    # Rubber on steel: the law itself, not a series in its place.
    cover = vc.Material(vc.PowerLaw(1e-7, 0.3, 1.0, instant=1e-7), poisson_ratio=0.49)
    body = vc.Layered([vc.Layer(1e-3, cover)], base=STEEL)
    surface = surface_of([body])
    assert len(surface.terms) == 2
    assert surface.splitting_error < 1e-7
    for time in (0.0, 1e-3, 7.0):
        assert surface.compliance(time) == close_to(cover.contact_compliance()(time), rel=1e-7)
