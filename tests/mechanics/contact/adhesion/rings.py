"""Axisymmetric sphere with the exponential law on rings of pressure, in units R = J = w = 1.

A dense independent computation: the displacement of a disc under a uniform pressure (Johnson 1985,
eq. 3.29), complementarity in contact, and Newton's method.
"""

import numpy as np
from scipy.special import ellipe, ellipk

#: Growth of the rings beyond the fine ones.
GROWTH = 1.03


def disc(edge, place):
    """Displacement at a radius under a unit pressure within an edge."""
    edge, place = np.broadcast_arrays(edge, place)
    found, inside = np.zeros(edge.shape), place <= edge
    a, r = edge[inside], place[inside]
    found[inside] = 4 * a / np.pi * ellipe((r / a) ** 2)
    a, r = edge[~inside], place[~inside]
    square = (a / r) ** 2
    found[~inside] = 4 * r / np.pi * (ellipe(square) - (1 - square) * ellipk(square))
    return found


class RingedSphere:
    """Sphere of a Tabor number: a number of equal rings up to a radius, then growing ones."""

    def __init__(self, tabor, fine, fine_radius=2.9, radius=16.0):
        self.reach, width = 1 / tabor, fine_radius / fine
        edges = list(width * np.arange(fine + 1))
        while edges[-1] < radius:
            edges.append(edges[-1] + width)
            width *= GROWTH
        inner, outer = np.array(edges[:-1]), np.array(edges[1:])
        places = 2 / 3 * (outer**3 - inner**3) / (outer**2 - inner**2)
        self.stiff = disc(outer[None, :], places[:, None])
        self.stiff[:, 1:] -= disc(inner[None, 1:], places[:, None])
        self.areas, self.widths = np.pi * (outer**2 - inner**2), outer - inner
        self.open_gap, self.pressure = places**2 / 2, np.zeros(len(places))

    def force(self, approach):
        """Force at an approach [π w R], from the state before."""
        for _ in range(60):
            gap = self.open_gap + self.stiff @ self.pressure - approach
            pull = np.exp(-np.maximum(gap, 0.0) / self.reach) / self.reach
            contact = (self.pressure + pull) * self.widths > gap
            lacking = np.where(contact, -gap / self.widths, -(self.pressure + pull))
            if np.abs(lacking).max() < 1e-10 / self.reach:
                return float(self.pressure @ self.areas) / np.pi
            of_gap = np.where(contact, 1 / self.widths, -pull / self.reach)
            matrix = of_gap[:, None] * self.stiff + np.diag(np.where(contact, 0.0, 1.0))
            self.pressure = self.pressure + np.linalg.solve(matrix, lacking)
        raise AssertionError("Newton's method on rings does not converge")

    def largest_pull(self, start, speed, ratio):
        """Largest pull [π w R] of a standard solid `ratio` times as stiff at once, of time 1.

        It is withdrawn from a relaxed state; pressures are linear in steps of 1 % of the force.
        """
        for approach in np.linspace(0.0, start, 3):
            force = self.force(approach)
        delayed, crept = 1 - 1 / ratio, (1 - 1 / ratio) * self.pressure
        approach, step, times, forces = start, 1e-4 / speed, [0.0], [force]
        while forces[-1] < 0.9 * min(forces) or len(forces) < 50 or min(forces) > -1.5:
            decay = np.exp(-step)
            late = 1 - (1 - decay) / step
            early = decay * crept + delayed * (1 - decay - late) * self.pressure
            found = self._creeping(approach - speed * step, 1 / ratio + delayed * late, early)
            force = np.inf if found is None else float(found @ self.areas) / np.pi
            if abs(force - forces[-1]) > 0.01 * max(1.0, -min(forces)):
                step /= 2
                continue
            crept, self.pressure = early + delayed * late * found, found
            approach -= speed * step
            times.append(times[-1] + step)
            forces.append(force)
            step *= 1.3
        least = int(np.argmin(forces))
        near = slice(least - 1, least + 2)
        bend, slope, level = np.polyfit(np.subtract(times[near], times[least]), forces[near], 2)
        return slope**2 / (4 * bend) - level

    def _creeping(self, approach, compliance, early):
        """Pressure under a compliance and what earlier pressures add to it; None without one."""
        found, past = self.pressure, self.open_gap + self.stiff @ early - approach
        for _ in range(30):
            gap = past + compliance * (self.stiff @ found)
            pull = np.exp(-np.maximum(gap, 0.0) / self.reach) / self.reach
            widths = self.widths * compliance
            contact = (found + pull) * widths > gap
            lacking = np.where(contact, -gap / widths, -(found + pull))
            if np.abs(lacking).max() < 1e-9 / self.reach:
                return found
            of_gap = compliance * np.where(contact, 1 / widths, -pull / self.reach)
            matrix = of_gap[:, None] * self.stiff + np.diag(np.where(contact, 0.0, 1.0))
            found = found + np.linalg.solve(matrix, lacking)
        return None
