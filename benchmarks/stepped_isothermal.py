"""Coverage of the shifts that are found in stepped isothermal tests with noise.

Five steps of 7 K, held for three hours each, 450 rows with 1 % of noise, a law of five terms over
six decades. The rows of the table are the share of seeds whose 95 % interval holds the parameters
of the rule, and log10 a_T of the hottest step; the mean half width of the latter's interval; and
the share of seeds in which the rule is chosen if none is named.

    python benchmarks/stepped_isothermal.py [--seeds 0:100]
"""

from __future__ import annotations

import argparse
import warnings

import numpy as np

import viscontact as vc
from viscontact.bodies.loads.clock import ReducedTime

STEPS, RISE, DWELL, CHANGE, FIRST = 5, 7.0, 3 * 3600.0, 720.0, 293.15
ROWS, NOISE = 450, 0.01
TIMES = (1e2, 2e3, 5e4, 1e6, 2e7)
CREEP = vc.CreepSeries(3e-10, [1e-10, 2e-10, 3e-10, 5e-10, 8e-10], TIMES)
RELAXATION = vc.RelaxationSeries(2e8, [4e8, 4e8, 3e8, 3e8, 2e8], TIMES)
SHIFTS = {"arrhenius": vc.Arrhenius(FIRST, 200e3), "wlf": vc.WLF(FIRST, 8.86, 101.6)}


def chamber() -> vc.TemperatureHistory:
    """Steps of the temperature, each with a short ramp."""
    begins = DWELL * np.arange(1, STEPS)
    times = np.concatenate([[0.0], np.stack([begins, begins + CHANGE], axis=1).ravel()])
    return vc.TemperatureHistory(times, FIRST + RISE * np.repeat(np.arange(STEPS), 2)[:-1])


def row_of(kind: str, name: str, seeds: range) -> str:
    """Row of the table for a kind of test and a rule."""
    shift, history = SHIFTS[name], chamber()
    times = np.linspace(0.0, STEPS * DWELL, ROWS + 1)[1:]
    reduced, temperature = ReducedTime(history, shift).reduced(times), history.at(times)
    exact = CREEP(reduced) if kind == "creep" else RELAXATION.relaxation(reduced)
    fit = vc.fit_creep if kind == "creep" else vc.fit_relaxation
    options = {"data": "deviatoric" if kind == "creep" else "shear", "temperature": temperature}
    options["reference_temperature"] = FIRST
    within, widths, chosen = [], [], 0
    for seed in seeds:
        values = exact * (1 + NOISE * np.random.default_rng(seed).standard_normal(times.size))
        found = fit(times, values, shift=name, **options).found_shift
        spans = found.intervals.items()
        inside = [low <= getattr(shift, key) <= high for key, (low, high) in spans]
        error = found.decades[-1] - np.log10(shift.factor(float(found.temperatures[-1])))
        within.append([*inside, abs(error) <= found.errors[-1]])
        widths.append(found.errors[-1])
        best = fit(times, values, **options).found_shift.shift
        chosen += isinstance(best, type(shift))
    shares = ", ".join(f"{each:.0%}" for each in np.mean(within, axis=0))
    width, part = np.mean(widths), chosen / len(seeds)
    return f"| {kind} | {name} | {shares} | {width:.3f} | {part:.0%} |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", default="0:100")
    first, last = map(int, parser.parse_args().seeds.split(":"))
    warnings.simplefilter("ignore")
    print("| test | rule | in: parameters, hottest step | half width | chosen |")
    for kind in ("creep", "relaxation"):
        for name in SHIFTS:
            print(row_of(kind, name, range(first, last)), flush=True)


if __name__ == "__main__":
    main()
