"""Displacement under a pressure that is given over time.

The surface is displaced by Σ_m K_m ∫ J_m(t - t') dp(t'), with the terms of the body (`surface`).
The pressure is uniform in each cell and linear in time between its instants, so that the integral
is a sum over these instants with means of J_m: there are no time steps, and no error of them.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.bodies.materials.compliance import ContactCompliance
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.problem.surface import SurfaceTerms


def creep_weights(compliance: ContactCompliance, instants: Floats, times: Floats) -> Floats:
    """Weights of the pressures at the instants in ∫ J dp at times, which are among them [1/Pa].

    >>> from viscontact.bodies.laws import Maxwell
    >>> from viscontact.bodies.materials.material import Material
    >>> fluid = Material(Maxwell(0.5, 0.5), poisson_ratio=0.0).contact_compliance()  # J = 1 + t
    >>> creep_weights(fluid, np.array([0.0, 2.0]), np.array([0.0, 2.0])).tolist()
    [[1.0, 0.0], [1.0, 2.0]]
    """
    weights = np.zeros((times.size, instants.size))
    for row, time in zip(weights, times, strict=True):
        past = instants[instants <= time]
        row[0] = compliance.since(past[:1], float(time))[0]
        if past.size > 1:
            rise = compliance.mean_since(past[:-1], past[1:], float(time))
            row[: past.size - 1] -= rise
            row[1 : past.size] += rise
    return weights


def displacement_under(
    pressures: Iterable[Floats],
    instants: Floats,
    surface: SurfaceTerms,
    grid: Grid,
    times: Floats,
) -> Floats:
    """Displacement at times [m], shape (times, nx, ny), under the pressures at the instants [Pa].

    The instants begin with that at which the pressure comes, and contain the times, or are fewer if
    the pressure is held.
    """
    weights = [creep_weights(term.compliance, instants, times) for term in surface.terms]
    operators = [ContactDomain(grid, response=t.response).convolution for t in surface.terms]
    found = np.zeros((times.size, *grid.shape))
    if instants.size < times.size:
        for index, pressure in enumerate(pressures):
            for operator, of_term in zip(operators, weights, strict=True):
                found += of_term[:, index, None, None] * operator.apply(pressure)
        return found
    weighted = np.zeros((len(weights), times.size, *grid.shape))  # ∫ J_m dp of each term [-]
    for index, pressure in enumerate(pressures):
        for total, of_term in zip(weighted, weights, strict=True):
            for k in np.flatnonzero(of_term[:, index]):
                total[k] += of_term[k, index] * pressure
    for operator, total in zip(operators, weighted, strict=True):
        for field, each in zip(found, total, strict=True):
            field += operator.apply(each)
    return found
