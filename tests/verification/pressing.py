"""What the verification tests press, on what, and how they judge the errors' rate."""

from dataclasses import dataclass

import numpy as np

import viscontact as vc

RADIUS, FORCE = 0.01, 10.0  # m, N
MODULUS = 2e9  # contact modulus E* = 2 G/(1 - nu) of ELASTIC [Pa]
ELASTIC = vc.Material(vc.Elastic(0.35 * MODULUS), poisson_ratio=0.3)
BALL = vc.Paraboloid(RADIUS, RADIUS)  # Hertz's sphere is a paraboloid


@dataclass(frozen=True)
class Shifted(vc.Indenter):
    """An indenter whose axis is off the origin: no cell centre needs to lie on it."""

    shape: vc.Indenter
    shift_x: float
    shift_y: float

    def gap(self, x, y):
        return self.shape.gap(np.asarray(x) - self.shift_x, np.asarray(y) - self.shift_y)

    @property
    def curvatures(self):
        return self.shape.curvatures


def grid_around(semi_axes, cells, *, margin=1.3, odd=True):
    """A grid with so many cells on each semi-axis; an odd one has a cell at the origin."""
    edges = [axis / count for axis, count in zip(semi_axes, cells, strict=True)]
    shape = tuple(2 * int(margin * count + 1) + odd for count in cells)
    return vc.Grid(shape, tuple(n * edge for n, edge in zip(shape, edges, strict=True)))


def press(indenter, grid, *, force=FORCE, tolerance=1e-6, **load):
    """The state under a force applied at once to ELASTIC."""
    states = vc.march(indenter, ELASTIC, vc.step(force, **load), grid, [0.0], tolerance=tolerance)
    return next(iter(states))


def central_pressure(grid, states):
    """Pressure of the cell at the origin of an odd grid, over time."""
    middle = tuple(n // 2 for n in grid.shape)
    return np.array([state.pressure[middle] for state in states])


def over_time(states, name):
    """One of the states' numbers, over time."""
    return np.array([getattr(state, name) for state in states])


def order(sizes, errors):
    """Exponent of the error's power law: slope of the straight line fitted to the logarithms."""
    return np.polyfit(np.log(sizes), np.log(errors), 1)[0]
