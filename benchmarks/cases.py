"""Cases of the benchmarks: the paper's rollers."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

import viscontact as vc

#: Half length of the paper's roller [m].
HALF_LENGTH = 9.565e-3

#: PMMA at room temperature, as in the paper (deviatoric).
PMMA = vc.CreepSeries(5.545e-10, [6.17e-11, 8.38e-11], [10.0, 133.87])


@dataclass(frozen=True)
class Case:
    """Arguments of `vc.march` except the tolerance."""

    indenter: vc.Indenter
    material: vc.Material
    load: vc.LoadHistory
    grid: vc.Grid
    times: np.ndarray

    def march(self, tolerance: float) -> Iterator[vc.ContactState]:
        arguments = (self.indenter, self.material, self.load, self.grid, self.times)
        return vc.march(*arguments, tolerance=tolerance)


def roller(
    crown_radius: float,
    eccentricity: float,
    cells: tuple[int, int] = (256, 256),
    steps: int = 120,
    law: vc.Law = PMMA,
) -> Case:
    """The paper's roller under 10 kN, `eccentricity` half lengths off centre, to 1000 s."""
    size = (60e-3, 3e-3) if crown_radius < 1 else (170e-3, 1.6e-3)
    return Case(
        vc.Roller(5e-3, HALF_LENGTH, crown_radius),
        vc.Material(law, 0.38),
        vc.step(1e4, eccentricity_x=eccentricity * HALF_LENGTH),
        vc.Grid(cells, size),
        vc.uniform_times(1000.0, steps),
    )
