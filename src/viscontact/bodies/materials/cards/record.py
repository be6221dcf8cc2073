"""One material of a card, in SI units, the same for all programs.

A reader of one program returns records; `card` makes the material of each.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Protocol

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import Elastic, Shift
from viscontact.bodies.materials.cards.card import Card
from viscontact.bodies.materials.cards.prony_terms import Moduli, Terms, relaxing_material
from viscontact.bodies.materials.material import Material


class Relaxation(Protocol):
    """How the moduli of a card depend on time, as it states it."""

    def material(self, moduli: Moduli) -> Material:
        """Return the material with these elastic constants."""


@dataclass(frozen=True)
class NoRelaxation:
    """No dependence on time: an elastic material."""

    def material(self, moduli: Moduli) -> Material:
        """Return the elastic material."""
        return Material(Elastic(moduli.shear), moduli.poisson_ratio)


@dataclass(frozen=True)
class PronySeries:
    """Prony terms of shear and bulk modulus, relative to their values at once."""

    shear: Terms
    bulk: Terms

    def material(self, moduli: Moduli) -> Material:
        """Return the material with a relaxation series."""
        return relaxing_material(moduli, self.shear, self.bulk)


@dataclass(frozen=True)
class Record:
    """What a card states about one material."""

    name: str
    moduli: Moduli
    relaxation: Relaxation
    shift: Shift | None = None
    notes: tuple[str, ...] = ()

    @property
    def card(self) -> Card:
        """The card with its material; ValueError with the line if there is no such law."""
        material = self.relaxation.material(self.moduli)
        notes = (*self.notes, *material.notes)
        return Card(self.name, replace(material, notes=()), self.shift, notes)
