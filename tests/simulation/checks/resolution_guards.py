"""Guards of what grids and time steps resolve, each met by a run and missed by one."""

from __future__ import annotations

import math

import numpy as np

import viscontact as vc
from simulation.checks.guarded_runs import (
    BALL,
    FEWER,
    FLUID,
    LINE_OF_CELLS,
    MEAN_PRESSED,
    SOFT,
    WAVES,
    Guard,
    Job,
    TwoHills,
    hertz_force,
    mapped,
    on_map,
)

RESOLUTION_GUARDS = {
    "contact at the edge of the grid": Guard(
        vc.DomainError,
        "the contact reaches the edge of the grid at t = 0 s; enlarge grid.size",
        met=Job(grid=vc.Grid((40, 40), (0.2, 0.2))),
        missed=Job(grid=vc.Grid((40, 40), (0.22, 0.22))),
    ),
    "far fewer cells than can be read": Guard(
        vc.DomainError,
        "3 cells lie across the run's largest contact and 4 are the least",
        met=Job(grid=vc.Grid((15, 15), (1.0, 1.0))),
        missed=Job(),
    ),
    "fewer cells than are wanted": Guard(
        vc.AccuracyWarning,
        "only 9 cells lie across the largest contact",
        met=Job(grid=vc.Grid((13, 13), (0.28, 0.28))),
        missed=Job(grid=vc.Grid((16, 16), (0.28, 0.28))),
    ),
    "enough cells one way, too few the other": Guard(
        vc.DomainError,
        "2 cells lie across",
        met=Job(grid=vc.Grid((4, 100), (0.6, 0.6))),
        missed=Job(grid=vc.Grid((40, 100), (0.6, 0.6))),
    ),
    "cells enough over all, and spots of one": Guard(
        vc.AccuracyWarning,
        "spots or strips",
        met=Job(mapped(0.1, 0.002, roughness=2e-4), **on_map),
        missed=Job(mapped(0.1, 0.002), **on_map),
    ),
    "a map finer than the grid": Guard(
        vc.AccuracyWarning,
        "the height map rises",
        met=Job(mapped(0.25, 0.005, roughness=1e-4), grid=vc.Grid((32, 32), (0.28, 0.28))),
        missed=Job(mapped(0.25, 0.005), grid=vc.Grid((32, 32), (0.28, 0.28))),
    ),
    "a turned map finer than the grid": Guard(
        vc.AccuracyWarning,
        "the height map rises",
        met=Job(
            mapped(0.25, 0.005, roughness=1e-4).rotated(0.3), grid=vc.Grid((32, 32), (0.28, 0.28))
        ),
        missed=Job(mapped(0.25, 0.005).rotated(0.3), grid=vc.Grid((32, 32), (0.28, 0.28))),
    ),
    "waves finer than the grid": Guard(
        vc.AccuracyWarning,
        "which are 9.8 of the grid's cells; 10 or more are wanted",
        met=Job(BALL + vc.Waviness(1e-6, wavelength_x=9.8 * 0.28 / 60)),
        missed=Job(BALL + vc.Waviness(1e-6, wavelength_x=10.2 * 0.28 / 60)),
    ),
    "waves that vary along one axis, on few cells along it or along the other": Guard(
        vc.AccuracyWarning,
        "over 100 mm along y, which are 4 of the grid's cells",
        met=Job(WAVES.rotated(math.pi / 2), MEAN_PRESSED, LINE_OF_CELLS),
        missed=Job(WAVES, MEAN_PRESSED, LINE_OF_CELLS),
    ),
    "dimples finer than the grid": Guard(
        vc.AccuracyWarning,
        "the body repeats itself over",
        met=Job((BALL + vc.Dimples(1e-6, 4.9 * 0.28 / 60, 0.1)).rotated(0.5)),
        missed=Job((BALL + vc.Dimples(1e-6, 5.1 * 0.28 / 60, 0.1)).rotated(0.5)),
    ),
    "a map that leaps from point to point": Guard(
        vc.AccuracyWarning,
        "the height map rises",
        # A third of a per cent of the approach, and the peak pressure is half as much again.
        met=Job(mapped(0.1, 0.002, roughness=1e-5), **on_map),
        missed=Job(mapped(0.1, 0.002), **on_map),
    ),
    "a body that would touch beyond the grid": Guard(
        vc.AccuracyWarning,
        "would touch outside the grid",
        met=Job(TwoHills(), grid=vc.Grid((40, 40), (0.3, 0.3))),
        missed=Job(TwoHills(), grid=vc.Grid((134, 40), (2.0, 0.6))),
    ),
    "a step long against the law": Guard(
        vc.AccuracyWarning,
        "a time step of 5 s is long against the law",
        met=Job(material=SOFT, times=[0.0, 5.0], grid=vc.Grid((40, 40), (0.8, 0.8))),
        missed=Job(
            material=SOFT,
            times=[0.0, *np.geomspace(0.02, 20, 80)],
            grid=vc.Grid((40, 40), (0.8, 0.8)),
        ),
    ),
    "a load put on in one step": Guard(
        vc.AccuracyWarning,
        "grows from nothing to 100% of its largest in a single step of 1 s",
        met=Job(
            material=SOFT,
            load=vc.ramp(hertz_force(0.1), 1.0),
            times=[0.0, 1.0],
            grid=vc.Grid((40, 40), (0.8, 0.8)),
        ),
        missed=Job(
            material=SOFT,
            load=vc.ramp(hertz_force(0.1), 1.0),
            times=np.linspace(0, 1, 41),
            grid=vc.Grid((40, 40), (0.8, 0.8)),
        ),
    ),
    "a load taken off in one step": Guard(
        vc.AccuracyWarning,
        "the contact is lost as the load falls by 100% of its largest in a single step of 1 s",
        met=Job(
            material=SOFT,
            load=vc.ForceHistory([0, 20, 21], [hertz_force(0.1)] * 2 + [0]),
            times=[0.0, *np.geomspace(0.02, 20, 80), 21.0],
            grid=vc.Grid((40, 40), (0.8, 0.8)),
        ),
        missed=Job(
            material=SOFT,
            load=vc.ForceHistory([0, 20, 21], [hertz_force(0.1)] * 2 + [0]),
            times=[0.0, *np.geomspace(0.02, 20, 80), *np.linspace(20, 21, 41)[1:]],
            grid=vc.Grid((40, 40), (0.8, 0.8)),
        ),
    ),
    "an approach that is taken back in one step": Guard(
        vc.AccuracyWarning,
        # Not all of it: the body has crept away, and the contact is lost before.
        "the contact is lost as the load falls by 70% of its largest in a single step of 200 ms",
        met=Job(
            material=FLUID,
            load=vc.ApproachHistory([0, 6, 6.2], [1e-2, 1e-2, 3e-3]),
            times=[0.0, *np.geomspace(0.02, 6, 160), 6.2],
        ),
        missed=Job(
            material=FLUID,
            load=vc.ApproachHistory([0, 6, 6.2], [1e-2, 1e-2, 3e-3]),
            times=[0.0, *np.geomspace(0.02, 6, 160), *np.linspace(6, 6.2, 41)[1:]],
        ),
    ),
    "a load that cycles between the instants asked for": Guard(
        vc.AccuracyWarning,
        "between the requested times the peak pressure reaches",
        met=Job(load=vc.harmonic(1e3, 8e2, 1.0, 2), grid=FEWER, times=[0.0, 1.0, 2.0]),
        missed=Job(load=vc.harmonic(1e3, 8e2, 1.0, 2), grid=FEWER, times=np.linspace(0, 2, 17)),
    ),
}
