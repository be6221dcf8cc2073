"""Adhesive contact of a rough surface that repeats, found from undeformed bodies."""

import numpy as np
import pytest

import viscontact as vc
from viscontact.bodies.cohesive_laws import LAWS
from viscontact.mechanics.contact.adhesion.equilibrium import solve_from, traction_at
from viscontact.mechanics.contact.adhesion.problem import AdhesiveProblem
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.problem import ContactProblem
from viscontact.mechanics.contact.rigid_balance import Constraints

#: Strength of the law in contact moduli.
STRENGTH = 0.02


def heights(cells, seed):
    """Self-affine, Hurst exponent 0.8, slope 0.1, 2 to 32 waves on a side of 1."""
    waves = np.fft.fftfreq(cells, 1 / cells)
    length = np.hypot(waves[:, None], waves[None, : cells // 2 + 1])
    size = np.where((length >= 2) & (length <= 32), length, np.inf) ** -1.8
    noise = np.fft.rfft2(np.random.default_rng(seed).standard_normal((cells, cells)))
    found = np.fft.irfft2(size * noise, (cells, cells))
    slopes = [np.diff(found, axis=axis, append=found.take([0], axis)) for axis in (0, 1)]
    return found * 0.1 / cells / np.sqrt(np.mean(np.square(slopes).sum(axis=0)))


def contact(cells, seed, part, *, from_afar):
    """Contact at a mean gap that is a part of the root mean square height."""
    height = heights(cells, seed)
    gap = part * height.std() - height
    domain = ContactDomain(vc.Grid((cells, cells), (1.0, 1.0), periodic=True))
    held = Constraints((None, None, None), (0.0, 0.0, 0.0))
    law = LAWS["exponential"](6e-5, 6e-5 / STRENGTH)
    problem = AdhesiveProblem(ContactProblem(gap, 1.0, held, 1e-12 / cells), law)
    start = traction_at(problem, domain, np.maximum(gap, 0.0))
    return solve_from(problem, domain, start, 1e-6, from_afar=from_afar)


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("part", [2.5, 1.4, 0.7])
def test_search_from_afar_finds_the_contact_of_an_accurate_one(seed, part):
    near, afar = (contact(128, seed, part, from_afar=each) for each in (False, True))
    assert near.converged
    assert afar.converged
    largest = np.abs(afar.found.pressure - near.found.pressure).max()
    assert largest < 1e-4 * STRENGTH
    assert afar.convolutions < 0.85 * near.convolutions


@pytest.mark.parametrize(
    "seed", [1, *(pytest.param(k, marks=pytest.mark.slow) for k in range(2, 6))]
)
@pytest.mark.parametrize("part", [2.5, 2.0, 1.5, 1.0, 0.7])
def test_contact_from_the_undeformed_bodies_takes_seventy_convolutions(seed, part):
    # 40 to 70 on these surfaces, 56 in the mean.
    found = contact(256, seed, part, from_afar=True)
    assert found.converged
    assert found.convolutions <= 70
    assert found.residual <= 1e-6
