"""Layered bodies: what is accepted, kept and refused."""

import pytest

import viscontact as vc
from closeness import close_to
from viscontact.results.descriptions import describe, rebuild

RUBBER = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.49)
STEEL = vc.Material(vc.Elastic(80e9), poisson_ratio=0.3)
COVER = vc.Layer(5e-3, RUBBER)


def test_a_body_is_kept_as_given_and_rebuilt_from_its_description():
    body = vc.Layered([COVER, vc.Layer(1e-3, STEEL)], base=RUBBER, bonded=[True, False])
    assert body.layers == (COVER, vc.Layer(1e-3, STEEL))
    assert body.bonded == (True, False)
    assert body.thickness == close_to(6e-3)
    assert body.materials == (RUBBER, STEEL, RUBBER)
    assert rebuild(describe(body)) == body
    rigid = vc.Layered([COVER], base="rigid")
    assert rigid.materials == (RUBBER,)
    assert rebuild(describe(rigid)) == rigid
    assert hash(rigid) == hash(vc.Layered((COVER,), "rigid", bonded=True))


def test_a_body_is_printed_in_readable_units():
    text = str(vc.Layered([COVER], base=STEEL, bonded=False))
    for row in ("layer 1 thickness", "5 mm", "base", "Elastic", "bonded", "no"):
        assert row.lower() in text.lower()
    assert "shape" not in text


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([], "rigid"), "layers must be a list of one Layer or more"),
        (([RUBBER], "rigid"), "layers must be a list of one Layer or more"),
        ((COVER, "rigid"), "layers must be a list of one Layer or more"),
        (([COVER], "stiff"), 'base must be a Material or "rigid"'),
        (([COVER], None), 'base must be a Material or "rigid"'),
        (([COVER], "rigid", [True, True]), "one of them for each of the 1 layers"),
        (([COVER], "rigid", 1), "bonded must be true or false"),
        (([COVER], "rigid", [1]), "bonded must be true or false"),
    ],
)
def test_wrong_bodies_are_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        vc.Layered(*arguments)


@pytest.mark.parametrize("thickness", [0.0, -1e-3, float("inf"), "thick", None])
def test_a_thickness_is_a_positive_length(thickness):
    with pytest.raises(ValueError, match="Layer: thickness must be"):
        vc.Layer(thickness, RUBBER)


def test_materials_with_a_thickness_of_their_own_are_refused():
    sheet = vc.Material(vc.Elastic(1e6), poisson_ratio=0.3, thickness=1e-3)
    with pytest.raises(ValueError, match="layer states a thickness of its own"):
        vc.Layer(2e-3, sheet)
    with pytest.raises(ValueError, match="base states a thickness of its own"):
        vc.Layered([COVER], base=sheet)
    with pytest.raises(ValueError, match="must be a Material"):
        vc.Layer(1e-3, vc.Elastic(1e6))
