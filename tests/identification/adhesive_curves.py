"""Force curves of adhering spheres from the exact solutions, with noise; the truth beside them."""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq

import viscontact as vc
from viscontact.reference import jkr_sphere, maugis_dugdale

RADIUS = 5e-6


def curve_of(sphere, stiffness, noise, rng, rows=600):
    """Force curve on a cantilever: approach, jump-in, retraction and jump-off.

    States are found by contact radius, one by one, not by the interpolated branch of the fit. The
    zero of the position is 1 µm before the first touch; the line has an offset and a slope.
    """
    length, depth = sphere._length, sphere._depth
    place = lambda a: (s := sphere.at_radius(a)).approach + s.force / stiffness  # noqa: E731
    radii = length * np.linspace(0.02, 3.0, 600)
    places = np.array([place(a) for a in radii])
    last = int(np.argmin(places))  # the base is pulled off here
    top, far = float(places[-1]), float(places[last]) - 6 * depth
    out = np.concatenate([np.linspace(far, top, rows), np.linspace(top, far, rows)])
    force, jumped_in = np.zeros_like(out), -sphere.range
    for row, z in enumerate(out):
        touching = z > (jumped_in if row < rows else places[last])
        if touching and z > places[last]:
            a = brentq(lambda a: place(a) - z, radii[last], radii[-1] * 1.01)  # noqa: B023
            force[row] = sphere.at_radius(a).force
    z = out + 1e-6
    pull = -sphere.pull_off.force
    bent = force / stiffness + 2e-9 + 1e-3 * z
    bent = bent + noise * pull / stiffness * rng.standard_normal(z.size)
    return vc.ForceCurve(np.linspace(0.0, 2.0, z.size), z, bent, stiffness)


def drawn(seed, tabor, noise=0.01):
    """Curve at a Tabor number, infinite for JKR, and its modulus [Pa], work and range."""
    rng = np.random.default_rng(seed)
    modulus, work = 10 ** rng.uniform(5.5, 7.0), 10 ** rng.uniform(-2.5, -1.0)
    length = np.cbrt(RADIUS * (work / modulus) ** 2) / tabor
    sphere = jkr_sphere(RADIUS, 1 / modulus, work)
    if length > 0:
        sphere = maugis_dugdale(RADIUS, 1 / modulus, work, length)
    unit = np.pi * work * RADIUS / sphere._depth
    curve = curve_of(sphere, unit * 10 ** rng.uniform(-0.3, 1.0), noise, rng)
    return curve, {
        "contact_modulus": modulus,
        "work": work,
        "tabor_number": tabor,
        "range": length,
    }
