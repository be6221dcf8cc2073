"""Rollers under traction, of one material and of two."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

import viscontact as vc

MU, RADIUS, LINE_LOAD = 0.3, 0.01, 100.0
RUBBER = vc.Material(vc.Elastic(1 / 3 * 1e6), 0.5)
HELD = {"tilt_x": 0.0, "tilt_y": 0.0}

#: C11, C22 and C23 of a circle at ν = 0, 0.25 and 0.5: J. J. Kalker (1990), table E.3.
LONGITUDINAL = {0.0: 3.40, 0.25: 4.12, 0.5: 5.20}
LATERAL = {0.0: 3.40, 0.25: 3.67, 0.5: 3.98}
BY_SPIN = {0.0: 1.33, 0.25: 1.47, 0.5: 1.63}


def half_width(compliance: float, force: float = LINE_LOAD, radius: float = RADIUS) -> float:
    """Half width of a line contact of contact compliance J [1/Pa] (Hertz) [m]."""
    return math.sqrt(4 * force * radius * compliance / math.pi)


#: J = (1 - ν)/(2G) of the rubber.
HALF = half_width(0.75e-6)
FULL = MU * HALF / RADIUS  # creepage from which on all slips (Carter)


def rolled(
    cells: int,
    way: float,
    *,
    material: vc.Material = RUBBER,
    half: float = HALF,
    speed: float = 0.1,
    creepage: float | None = None,
    lateral: float | None = None,
    tangential: Any = None,
    **given: Any,
) -> list[vc.ContactState]:
    """A roller over a way of some half widths along y, a cell a step, from rest."""
    cell = 2 * half / cells
    steps = round(way * half / cell)
    count = steps + 4 * cells
    travel = steps * cell
    grid = vc.Grid(
        (1, count), (1.0, count * cell), centre=(0.0, travel / 2), periodic=(True, False)
    )
    times = np.arange(steps + 1) * cell / speed
    creepages = {"creepage": creepage, "lateral_creepage": lateral}
    path = vc.Travel([0.0, times[-1]], y=[0.0, travel], rolling=True, **creepages)
    return list(
        vc.march(
            vc.Paraboloid(math.inf, RADIUS),
            material,
            vc.step(LINE_LOAD, **HELD),
            grid,
            times,
            friction=MU,
            motion=path,
            tangential=tangential,
            **given,
        )
    )


def pulled(part: float) -> vc.TangentialHistory:
    """A force of a part of what friction carries, which drives towards +y."""
    return vc.tangential_step(force_y=-part * MU * LINE_LOAD)


#: A roller of one metal on a plane of another (mm, N, MPa): that of `bentall.inp` of CONTACT, with
#: the contact of Hertz 0.1 mm wide to both sides. (1 - 2ν) J/(2 (1 - ν)) differs by 0.1438 of J.
ALUMINIUM, IRON = (
    vc.Material(vc.Elastic(g), ratio) for g, ratio in ((23000.0, 0.31), (8.2e4, 0.28))
)
DISSIMILAR_FORCE, DISSIMILAR_RADIUS = 16.2019, 25.0


def dissimilar(
    cells: int,
    way: float,
    friction: float,
    part: float = 0.0,
    *,
    exchanged: bool = False,
    creepage: float | None = None,
    iron: vc.Material | None = None,
) -> vc.ContactState:
    """Coupled bodies, rolling under a part of what friction carries or under a creepage."""
    cell = 0.2 / cells
    steps = round(way * cells / 2)
    count = cells + 16 + steps
    count += count % 2
    plane, roller = iron or IRON, ALUMINIUM
    if exchanged:
        plane, roller = roller, plane
    force_y = part * friction * DISSIMILAR_FORCE
    path = {"y": [0.0, steps * cell], "rolling": True, "creepage": creepage}
    *_, last = vc.march(
        vc.Paraboloid(math.inf, DISSIMILAR_RADIUS),
        plane,
        vc.step(DISSIMILAR_FORCE, **HELD),
        vc.Grid((1, count), (1.0, count * cell), (True, False), centre=(0.0, steps * cell / 2)),
        np.arange(steps + 1) * cell,
        indenter_material=roller,
        friction=friction,
        tangential=vc.tangential_step(force_y=force_y) if creepage is None else None,
        motion=vc.Travel([0.0, steps * cell], **path),
    )
    return last


def bufler() -> tuple[float, float]:
    """Creepage, and largest pressure over Hertz', of free rolling without slip.

    With f = p + i q the stick condition of a long roller is (1/π) ∫ f ds/(y - s) + i c f = (y/R -
    i ξ)/(2J), solved by f ~ (a - y)^(1/2 + i ε) (a + y)^(1/2 - i ε) with ε = ln((1 + c)/(1 - c))
    over 2π; H. Bufler, Ing.-Arch. 28 (1959) 157; K. L. Johnson (1985), section 8.2.
    """
    whole = [(1 - m.poisson_ratio) / (2 * g) for m, g in ((ALUMINIUM, 23000.0), (IRON, 8.2e4))]
    own = [
        (1 - 2 * m.poisson_ratio) / (2 * (1 - m.poisson_ratio)) * each
        for m, each in zip((ALUMINIUM, IRON), whole, strict=True)
    ]
    c = (own[0] - own[1]) / sum(whole)
    exponent = math.log((1 + c) / (1 - c)) / (2 * math.pi)
    hertz = math.sqrt(4 * DISSIMILAR_FORCE * DISSIMILAR_RADIUS * sum(whole) / math.pi)
    half = hertz / math.sqrt(1 + 4 * exponent**2)
    return 2 * exponent * half / DISSIMILAR_RADIUS, half


#: CREEP X, PMAX and cells in adhesion of 200 by FX/FSTAT/FN, cases 4 to 6 of `bentall.ref_out`:
#: friction 0.05; R. H. Bentall and K. L. Johnson, Int. J. Mech. Sci. 9 (1967) 389.
BENTALL = {0.0: (4.294e-4, 103.6, 125), 0.75: (2.108e-4, 103.2, 36), -0.75: (5.392e-4, 103.3, None)}
