"""Runs of every kind that are made again and again: in this process, or in one of their own.

As a program, `python -m verification.repeated_runs FOLDER`, it makes all of them and keeps every
array of the results, bit for bit.
"""

import sys
import warnings

import numpy as np

import viscontact as vc

rubber = vc.Material(vc.RelaxationSeries(1e6, [4e6, 1e6, 5e5], [0.1, 1.0, 10.0]), 0.45)
measured_times = np.geomspace(1e-2, 20.0, 30)
measured = vc.Material(
    vc.TabulatedCreep([0.0, *measured_times], [2e-7, *(2e-7 + 3e-7 * measured_times**0.4)]), 0.4
)
powdery = vc.Material(vc.PowerLaw(4e-7, 0.3, 1.0, instant=1e-7), 0.5)


#: Without the coarser runs of error bars, which others have.
ALONE = {"errors": False}


def _roller():
    roller = vc.Roller(5e-3, 1e-2, 75e-3)
    grid = vc.Grid((96, 64), (40e-3, 2.0e-3))
    load = vc.step(4.0, eccentricity_x=4e-3)
    return (roller, rubber, load, grid, vc.log_times(0.03, 30.0, 8)), {}


def _rough():
    rng = np.random.default_rng(7)
    axis = np.linspace(-1e-3, 1e-3, 60)
    ground = vc.HeightMap(axis, axis, 2e-6 * rng.standard_normal((60, 60)))
    load = vc.ForceHistory([0, 1, 2, 3], [2.0, 2.0, 0.0, 1.5], 1e-4, -2e-4)
    grid = vc.Grid((72, 75), (2.2e-3, 2.2e-3))
    return (ground, rubber, load, grid, np.linspace(0.0, 4.0, 9)), {}


def _table():
    # Past and present of 2 x 128 x 128 numbers, 20 times: what is summed is long enough for
    # libraries of linear algebra to share it out among threads.
    grid = vc.Grid((128, 128), (1.2e-3, 1.2e-3))
    load = vc.triangle(0.03, 4.0, eccentricity_x=2e-5)
    return (vc.Sphere(5e-3), measured, load, grid, np.linspace(0.0, 10.0, 21)), ALONE


def _adaptive():
    grid = vc.Grid((48, 48), (1.2e-3, 1.2e-3))
    load = vc.ramp(0.02, 1.0, eccentricity_y=3e-5)
    return (vc.Sphere(5e-3), powdery, load, grid, vc.adaptive_times(10.0, 4e-2)), ALONE


def _stage():
    grid = vc.Grid((64, 50), (1.5e-3, 1.0e-3))
    load = vc.ApproachHistory([0, 1, 2, 3, 4], [1e-5, 2e-5, -1e-6, -1e-6, 2e-5], 1e-3, None)
    return (vc.Paraboloid(5e-3, 3e-3), powdery, load, grid, np.linspace(0.0, 5.0, 11)), {}


def _two_bodies():
    grid = vc.Grid((36, 36), (1.5e-3, 1.5e-3))
    load = vc.harmonic(0.02, 0.01, 2.0, 1, eccentricity_x=2e-5)
    times = np.linspace(0.0, 2.0, 5)
    return (vc.Sphere(5e-3), rubber, load, grid, times), {"indenter_material": measured} | ALONE


CASES = {
    "roller, load aside": _roller,
    "rough surface, lifted and pressed again": _rough,
    "table, summed over the past": _table,
    "adaptive steps": _adaptive,
    "stage": _stage,
    "two creeping bodies": _two_bodies,
}


def arrays(name, threads=1):
    """Every array of the result, by name."""
    arguments, options = CASES[name]()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        result = vc.simulate(*arguments, threads=threads, **options)
    return {str(key): result[key].to_numpy() for key in result.variables}


if __name__ == "__main__":
    for number, case in enumerate(CASES):
        np.savez(f"{sys.argv[1]}/{number}.npz", **arrays(case))
