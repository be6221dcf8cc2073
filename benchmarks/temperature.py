"""Cost of a run under a temperature, compared with that of the law at this temperature.

A sphere on 128 x 128 cells under a force that rises and is held, in 60 steps, on a law of three
exponentials: at a constant temperature, given as a number; on the clock of a temperature that does
not vary before the end of the run; under one that rises by 10 K; and the law itself in steps that
are as unequal as those of this clock, whose weights are computed for each. Times are of one thread,
the least of some repetitions that take turns.
"""

from __future__ import annotations

import argparse
import time
import warnings
from collections.abc import Callable
from functools import partial

import numpy as np

import viscontact as vc

WARM, END = 303.15, 100.0
LAW = vc.CreepSeries(5e-7, [1e-7, 2e-7, 4e-7], [1.0, 10.0, 100.0])
MATERIAL = vc.Material(LAW, 0.5, shift=vc.WLF(293.15, 8.86, 101.6))
LATER = vc.TemperatureHistory([0.0, 2 * END, 3 * END], [WARM, WARM, WARM + 10.0])
RISING = vc.TemperatureHistory([0.0, END], [WARM - 5.0, WARM + 5.0])
UNIFORM = vc.uniform_times(END, 60)


def unequal_times() -> np.ndarray:
    """Times whose steps are as long as the uniform ones on the clock of the rising temperature."""
    reduced = MATERIAL.clock(RISING).reduced(UNIFORM)
    return END * reduced / reduced[-1]


def run(material: vc.Material, temperature: object, times: np.ndarray = UNIFORM) -> None:
    """Run the contact."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        vc.simulate(
            *(vc.Sphere(0.01), material, vc.ramp(0.5, END / 4), vc.Grid((128, 128), (5e-3, 5e-3))),
            times,
            temperature=temperature,
            fields="none",
            errors=False,
        )


RUNS: dict[str, Callable[[], None]] = {
    "law at the temperature": partial(run, MATERIAL.at(WARM), None),
    "constant temperature": partial(run, MATERIAL, WARM),
    "constant so far, on the clock": partial(run, MATERIAL, LATER),
    "rising by 10 K": partial(run, MATERIAL, RISING),
    "law in unequal steps": partial(run, MATERIAL.at(WARM), None, unequal_times()),
}


def seconds(act: Callable[[], None]) -> float:
    """Processor time of a call [s]."""
    started = time.process_time()
    act()
    return time.process_time() - started


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--repeat", type=int, default=5)
    repeat = parser.parse_args().repeat
    run(MATERIAL, WARM)  # imports and plans of transforms
    found: dict[str, list[float]] = {name: [] for name in RUNS}
    for _ in range(repeat):
        for name, act in RUNS.items():
            found[name].append(seconds(act))
    least = {name: min(each) for name, each in found.items()}
    base = least["law at the temperature"]
    print("| run | time [s] | over the first |\n|---|---|---|")
    for name, each in least.items():
        print(f"| {name} | {each:.2f} | {each / base:.3f} |")


if __name__ == "__main__":
    main()
