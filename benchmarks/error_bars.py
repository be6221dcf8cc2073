"""Cost of the error bars, beside the cost of the run whose errors they are.

Runs and estimates take turns, in one process, without output. The shipped examples come first, then
balls on a creeping half-space, aside of the grid's symmetry and symmetric. A ratio is the CPU time
of the estimate over that of the run, the least of the repetitions of each; the last line of a group
is the ratio of the sums.

    python benchmarks/error_bars.py [--repeat 3] [--only PART_OF_A_NAME]
"""

from __future__ import annotations

import argparse
import time
import warnings
from collections.abc import Callable, Iterator
from importlib.resources import as_file, files

import viscontact as vc
from viscontact.case import read_case
from viscontact.mechanics.problem.problem import Problem
from viscontact.runs.preparation import prepared
from viscontact.simulation.accuracy.coarser_results import History, history_of
from viscontact.simulation.accuracy.coarser_runs import march_coarser_run, plan_coarser_runs
from viscontact.simulation.accuracy.error_bars import error_bars
from viscontact.simulation.transient.setup import RunSetup, prepare_run
from viscontact.simulation.transient.state_generator import march_run

#: Cells along an edge, steps, whether the problem is symmetric.
SIZES = (
    (48, 20, False),
    (128, 40, False),
    (128, 40, True),
    (128, 100, False),
    (128, 100, True),
    (256, 24, False),
    (256, 24, True),
    (384, 16, False),
)


def examples() -> Iterator[tuple[str, Callable[[], RunSetup]]]:
    """Shipped cases that march over time."""
    folder = files("viscontact.case.examples")
    for entry in sorted(folder.iterdir(), key=lambda each: each.name):
        if entry.name.endswith(".yaml") and "kind: steady" not in entry.read_text():
            yield entry.name.removesuffix(".yaml"), lambda entry=entry: _example(entry.name)


def _example(name: str) -> RunSetup:
    with as_file(files("viscontact.case.examples")) as folder:
        return prepared(read_case(folder / name)).run.setup


def balls() -> Iterator[tuple[str, Callable[[], RunSetup]]]:
    """Balls on a Zener body, ramped up and held."""
    for cells, steps, symmetric in SIZES:
        name = f"{cells}² x {steps}" + (" symmetric" if symmetric else "")
        yield name, lambda of=(cells, steps, symmetric): _ball(*of)


def _ball(cells: int, steps: int, symmetric: bool) -> RunSetup:
    material = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
    tilt = 0.0 if symmetric else 0.004
    load = vc.ramp(0.1, 0.5, tilt_x=tilt, tilt_y=tilt / 2)
    grid = vc.Grid((cells, cells), (2.4e-3, 2.4e-3))
    return prepare_run(
        Problem(vc.Paraboloid(0.01, 0.01), material, load, grid, vc.uniform_times(4.0, steps))
    )


def marched(setup: Callable[[], RunSetup]) -> tuple[float, RunSetup, History]:
    """CPU time of a run with its set-up [s], the run on its last grid, and its scalars."""
    begun = time.process_time()
    run = setup()
    states = [state.without_fields() for state in march_run(run)]
    seconds = time.process_time() - begun
    return seconds, run.on(states[-1].grid), history_of(states)


def parts(run: RunSetup, history: History) -> list[float]:
    """CPU times of the coarser runs [s]."""
    found, begun = [], time.process_time()
    for each in plan_coarser_runs(run, history):
        march_coarser_run(each)
        found.append(time.process_time() - begun)
        begun = time.process_time()
    return found


def measured(setup: Callable[[], RunSetup], repeat: int) -> tuple[float, float, list[float]]:
    """Least CPU times of run and estimate, and those of its coarser runs [s]."""
    runs, estimates = [], []
    for _ in range(repeat):
        seconds, last, history = marched(setup)
        runs.append(seconds)
        begun = time.process_time()
        error_bars(last, history)
        estimates.append(time.process_time() - begun)
    return min(runs), min(estimates), parts(last, history)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--only", default="")
    given = parser.parse_args()
    warnings.simplefilter("ignore", vc.AccuracyWarning)
    print(f"{'':26}{'run s':>8}{'bars s':>8}{'ratio':>7}  coarser runs s")
    for group in (examples(), balls()):
        sums = [0.0, 0.0]
        for name, setup in group:
            if given.only not in name:
                continue
            run, bars, each = measured(setup, given.repeat)
            sums[0] += run
            sums[1] += bars
            shown = " ".join(f"{seconds:.2f}" for seconds in each)
            print(f"{name:26}{run:8.3f}{bars:8.3f}{bars / run:7.2f}  {shown}", flush=True)
        if sums[0]:
            print(f"{'sum':26}{sums[0]:8.3f}{sums[1]:8.3f}{sums[1] / sums[0]:7.2f}")


if __name__ == "__main__":
    main()
