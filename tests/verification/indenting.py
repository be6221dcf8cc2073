"""Round bodies pressed by any history, and how far the march is from exact solutions."""

import math
from dataclasses import dataclass

import numpy as np

import viscontact as vc
from verification.pressing import BALL, grid_around, over_time


@dataclass(frozen=True)
class Pressed:
    """A run: its instants, its cell size, its states."""

    times: np.ndarray
    cell: float
    states: list

    @property
    def force(self):
        return over_time(self.states, "force")

    @property
    def approach(self):
        return over_time(self.states, "approach")

    @property
    def radius(self):
        """Radius of the circle of the traced area."""
        return np.sqrt(over_time(self.states, "contact_area") / math.pi)

    @property
    def touching(self):
        """Whether there is contact."""
        outcomes = over_time(self.states, "outcome")
        return outcomes == vc.Outcome.CONVERGED

    def changes(self):
        """Instants at which contact is made or lost: in the middle of the step, half its length."""
        ends = np.flatnonzero(np.diff(self.touching))
        before, after = self.times[ends], self.times[ends + 1]
        return (before + after) / 2, (after - before) / 2


def pressed(material, load, times, radius, *, cells, odd=True, tolerance=1e-7, **options):
    """Press BALL on a grid with so many cells on a radius, which is to be the largest."""
    grid = grid_around((radius, radius), (cells, cells), margin=1.15, odd=odd)
    states = list(vc.march(BALL, material, load, grid, times, tolerance=tolerance, **options))
    return Pressed(np.asarray(times), grid.cell_size[0], states)


def deviation(found, exact):
    """Largest difference, over the largest value."""
    return np.abs(found - exact).max() / np.abs(exact).max()


def around(instants, width, parts=8):
    """Instants close about others: each in so many parts to either side."""
    offsets = width * np.arange(-parts, parts + 1) / parts
    return np.add.outer(np.atleast_1d(instants), offsets).ravel()
