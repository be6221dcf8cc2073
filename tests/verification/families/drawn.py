"""Families of runs with independent truths, and random draws from them."""

import zlib
from collections.abc import Callable, Iterator

import numpy as np

from verification.families.adhering_bodies import maugis_sphere, pulled_program, sticking_body
from verification.families.blunt_bodies import blunt_apex, rounded_punch, shrinking_contact
from verification.families.eccentric_bodies import eccentric_ball, eccentric_ellipsoid
from verification.families.ellipses import slender_ellipse, turned_ellipse
from verification.families.exact_run import ExactRun, NotDrawnError
from verification.families.gripping_bodies import (
    coupled_body,
    pulled_body,
    shifted_body,
    turned_body,
)
from verification.families.layered_bodies import covered_core, layered_ball, layered_cylinder
from verification.families.load_programs import load_program
from verification.families.punches import dent, eccentric_punch, punch
from verification.families.rollers import roller
from verification.families.round_bodies import automatic, harmonic_load, held_ball, round_body
from verification.families.tables import first_touch, spike, table_of_load
from verification.families.tilted_balls import tilted_ball, wide_law
from verification.families.waves import full_contact, line_waves

Draw = Callable[[np.random.Generator], ExactRun]

#: Families on which the factors of the bars were chosen, with seeds below 100.
CALIBRATED: dict[str, Draw] = {
    each.__name__: each
    for each in (
        round_body,
        table_of_load,
        spike,
        first_touch,
        turned_ellipse,
        punch,
        dent,
        line_waves,
        roller,
    )
}

#: Families that were left out of the choice of kinds and limits, and looked at in that of the
#: common factors only; the bar of a crest between cells follows from a parabola.
HELD_OUT: dict[str, Draw] = {
    each.__name__: each
    for each in (
        held_ball,
        harmonic_load,
        automatic,
        tilted_ball,
        wide_law,
        slender_ellipse,
        eccentric_punch,
        full_contact,
    )
}

#: Bodies on layers, with seeds from 305 on for what is reported.
LAYERED: dict[str, Draw] = {
    each.__name__: each for each in (layered_ball, layered_cylinder, covered_core)
}

#: Bodies whose bars were short before, with seeds below 100 for the choice.
BLUNT: dict[str, Draw] = {
    each.__name__: each
    for each in (
        blunt_apex,
        shrinking_contact,
        rounded_punch,
        eccentric_ball,
        eccentric_ellipsoid,
        load_program,
    )
}

#: Bodies under friction, whose bars were fitted to spheres alone, under one force.
GRIPPING: dict[str, Draw] = {
    each.__name__: each for each in (pulled_body, shifted_body, turned_body)
}

#: Bodies that adhere, with seeds 1 and 2 for the choice.
ADHERING: dict[str, Draw] = {
    each.__name__: each for each in (maugis_sphere, sticking_body, pulled_program)
}

#: Coupled bodies under friction, whose bars were chosen on seven draws of each of two sets.
COUPLED: dict[str, Draw] = {each.__name__: each for each in (coupled_body,)}

FAMILIES = CALIBRATED | HELD_OUT | LAYERED | BLUNT | GRIPPING | ADHERING | COUPLED


def drawn(
    seed: int, count: int, families: tuple[str, ...] = tuple(FAMILIES)
) -> Iterator[tuple[str, ExactRun]]:
    """A number of runs of the families in turn; each has a generator of its own."""
    for k in range(count):
        name = families[k % len(families)]
        number = zlib.crc32(name.encode())
        yield name, draw(name, np.random.default_rng([seed, number, k // len(families)]))


def draw(family: str, rng: np.random.Generator) -> ExactRun:
    """A run of a family; what has no exact solution is drawn again."""
    for _ in range(40):
        try:
            return FAMILIES[family](rng)
        except NotDrawnError:
            continue
    raise AssertionError(f"{family}: nothing could be drawn")
