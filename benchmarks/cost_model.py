"""Time and memory traffic of the parts of the roller's run.

The parts are timed exclusively (without the parts that they call), in CPU time, by timers around
functions of the package; a timer costs about 1 us per call. A further run counts the memory
traffic of each part (passes.py) in fields: one value in double precision on all computed cells, so
an addition of two fields into a third moves 3. It also counts the new arrays of at least an eighth
of such a field. Page faults give the part of this memory that the operating system newly provided.

    python benchmarks/cost_model.py [--tolerance 1e-5 1e-6 1e-8] [--cells 256 256] [--steps 120]
"""

from __future__ import annotations

import argparse
import functools
import platform
import resource
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from datetime import date
from typing import Any

import numpy as np
import scipy
from cases import Case, roller
from passes import counted
from run import reference_convolution, seconds_of

import viscontact as vc
from viscontact.backend import compiled
from viscontact.mechanics.contact import conjugate_gradients, domain, equilibrium, patch, winkler
from viscontact.mechanics.halfspace import convolution, preconditioner
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.time_integration.internal_variables import InternalVariables
from viscontact.simulation.transient import stepper
from viscontact.simulation.transient.observer import Observer
from viscontact.simulation.transient.setup import prepare_run
from viscontact.simulation.transient.state_generator import march_run

#: Parts of a step, and their functions: the module or class, and the name.
PARTS: tuple[tuple[str, tuple[tuple[Any, str], ...]], ...] = (
    ("operators: set-up", ((domain.ContactDomain, "__init__"), (domain.ContactDomain, "_patch"))),
    ("convolution", ((convolution.Convolution, "apply"),)),
    ("preconditioner", ((preconditioner.Preconditioner, "apply"),)),
    (
        "residual: gap and error",
        ((conjugate_gradients, "contact_residual"), (equilibrium, "contact_residual")),
    ),
    ("directions: project, inner products", ((conjugate_gradients.BoundedCG, "_advance"),)),
    (
        "step: move, truncate, equilibrium",
        ((conjugate_gradients.BoundedCG, "_take"), (conjugate_gradients.BoundedCG, "__init__")),
    ),
    ("solve: embed, verify, equilibrium", ((stepper, "solve_contact"),)),
    ("first initial guess", ((equilibrium, "winkler_contact"), (winkler, "winkler_contact"))),
    ("hereditary integral: evaluate", ((InternalVariables, "ramp"), (InternalVariables, "jump"))),
    ("hereditary integral: update", ((InternalVariables, "accept"),)),
    ("initial guess", ((stepper, "predict"), (stepper, "_guess"))),
    (
        "elastic reference and time error",
        ((stepper.Stepper, "_trial_step"), (stepper.Stepper, "accept")),
    ),
    ("state: unfold", ((stepper, "_on_full_grid"),)),
    (
        "state: contact edge, area, work, warnings",
        ((Observer, "evaluate"), (Observer, "add_warnings")),
    ),
    ("preparation", ((vc.march.__globals__["prepare_run"].__globals__, "prepare_run"),)),
)


@dataclass
class Clocks:
    """Exclusive CPU time [s] and calls of each part."""

    seconds: Counter[str] = field(default_factory=Counter)
    calls: Counter[str] = field(default_factory=Counter)
    moved: Counter[str] = field(default_factory=Counter)
    made: Counter[str] = field(default_factory=Counter)
    counts_from: float = np.inf
    _running: list[str] = field(default_factory=lambda: ["other"])
    _since: float = 0.0

    def start(self) -> None:
        self._since = time.process_time()

    def enter(self, part: str) -> None:
        self._charge()
        self.calls[part] += 1
        self._running.append(part)

    def leave(self) -> None:
        self._charge()
        self._running.pop()

    def count(self, moved: int, made: int) -> None:
        """Count bytes that were read or written, and the bytes of a new array."""
        self.moved[self._running[-1]] += moved
        self.made[self._running[-1]] += made >= self.counts_from

    def _charge(self) -> None:
        now = time.process_time()
        self.seconds[self._running[-1]] += now - self._since
        self._since = now


def clocked(act: Callable[..., Any], part: str, clocks: Clocks) -> Callable[..., Any]:
    @functools.wraps(act)
    def timed(*args: Any, **kwargs: Any) -> Any:
        name = f"{part}, {_precision(args[0])}" if part == "convolution" else part
        clocks.enter(name)
        try:
            return act(*args, **kwargs)
        finally:
            clocks.leave()

    return timed


def _precision(operator: Any) -> str:
    single = operator._number == np.float32
    return "single, on the patch" if single else "double, on the whole grid"


@contextmanager
def clocks_around_parts(clocks: Clocks) -> Iterator[None]:
    """Install the timers, and remove them at the end."""
    # Not several parts in one call of the core.
    before = [(patch.PatchOperators, "compiled", patch.PatchOperators.compiled)]
    for owner, name, _ in before:
        setattr(owner, name, None)
    for part, functions in PARTS:
        for owner, name in functions:
            if isinstance(owner, dict) or not hasattr(owner, name):
                continue
            original = getattr(owner, name)
            before.append((owner, name, original))
            setattr(owner, name, clocked(original, part, clocks))
    try:
        yield
    finally:
        for owner, name, original in reversed(before):
            setattr(owner, name, original)


@dataclass(frozen=True)
class Costs:
    """Cost of a run: CPU time [s] and calls by part, iterations, new memory [bytes]."""

    seconds: Counter[str]
    calls: Counter[str]
    iterations: int
    steps: int
    new_memory: int

    @property
    def total(self) -> float:
        return sum(self.seconds.values())


def costs_of(case: Case, tolerance: float) -> Costs:
    clocks, iterations, steps = Clocks(), 0, 0
    faults = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    clocks.start()
    with clocks_around_parts(clocks):
        for state in case.march(tolerance):
            iterations += state.iterations
            steps += 1
    clocks._charge()
    new = (resource.getrusage(resource.RUSAGE_SELF).ru_minflt - faults) * resource.getpagesize()
    return Costs(clocks.seconds, clocks.calls, iterations, steps, new)


@dataclass(frozen=True)
class Counts:
    """Fields moved and arrays created per step, by part."""

    moved: dict[str, float]
    made: dict[str, float]


def counts_of(case: Case, tolerance: float) -> Counts:
    """Repeat the run, and count the memory traffic of its parts."""
    given = (case.indenter, case.material, case.load, case.grid, case.times)
    run = prepare_run(Problem(*given, tolerance=tolerance))
    cell_count = np.prod(case.grid.shape) / 2 ** sum(run.mirrored)
    clocks = Clocks(counts_from=cell_count)  # bytes: an eighth of a field of doubles
    with clocks_around_parts(clocks), counted(clocks.count):
        steps = sum(1 for _ in march_run(run))
    return Counts(
        {part: moved / (8 * cell_count * steps) for part, moved in clocks.moved.items()},
        {part: made / steps for part, made in clocks.made.items()},
    )


def table(costs: Costs, counts: Counts, case: Case, reference: float) -> str:
    per_step = 1e3 / costs.steps
    lines = [f"{'':44} calls/step  ms/step  of the run  fields moved  arrays made"]
    for part, seconds in costs.seconds.most_common():
        if seconds < 0.004 * costs.total:
            continue
        lines.append(
            f"{part:44} {costs.calls[part] / costs.steps:10.2f} {seconds * per_step:8.3f}"
            f" {seconds / costs.total:10.1%}"
            f" {counts.moved.get(part, 0):13.1f} {counts.made.get(part, 0):12.1f}"
        )
    fields = costs.new_memory / costs.steps / (8 * np.prod(case.grid.shape))
    lines.append(
        f"{'all':44} {'':10} {costs.total * per_step:8.3f} {'':10}"
        f" {sum(counts.moved.values()):13.1f} {sum(counts.made.values()):12.1f}\n"
        f"{costs.total:.2f} s, {costs.total / reference:.0f} reference convolutions,"
        f" {costs.iterations / costs.steps:.2f} iterations per step;"
        f" new memory per step: {fields:.1f} fields of the whole grid"
    )
    return "\n".join(lines)


def where_and_when() -> str:
    return (
        f"{date.today()}, {platform.machine()}, Python {platform.python_version()}, "
        f"NumPy {np.__version__}, SciPy {scipy.__version__}, viscontact {vc.__version__}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tolerance", type=float, nargs="+", default=[1e-5, 1e-6, 1e-8])
    parser.add_argument("--cells", type=int, nargs=2, default=(256, 256))
    parser.add_argument("--steps", type=int, default=120)
    parser.add_argument("--crown", type=float, nargs="+", default=[75.0, 7500.0], help="mm")
    parser.add_argument("--eccentricity", type=float, nargs="+", default=[0.5], help="of L")
    parser.add_argument("--repeat", type=int, default=3)
    options = parser.parse_args()
    compiled.core = None  # what the core does is in no array that counts
    print(where_and_when())
    convolve = reference_convolution(tuple(options.cells))
    convolve()
    reference = min(seconds_of(convolve) for _ in range(60))
    print(f"one reference convolution: {reference * 1e3:.2f} ms")
    for crown in options.crown:
        for eccentricity in options.eccentricity:
            case = roller(crown * 1e-3, eccentricity, tuple(options.cells), options.steps)
            for tolerance in options.tolerance:
                runs = [costs_of(case, tolerance) for _ in range(options.repeat)]
                best = min(runs, key=lambda costs: costs.total)
                print(f"\ncrown {crown:g} mm, e/L = {eccentricity:g}, tolerance {tolerance:g}")
                print(table(best, counts_of(case, tolerance), case, reference), flush=True)


if __name__ == "__main__":
    main()
