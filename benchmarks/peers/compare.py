"""Comparison with other programs: the same problems, one thread each, at equal measured error.

Each program runs at a ladder of tolerances in its own environment (see build.py). The error of a
pressure is its relative L2 distance from the solution at tolerance 1e-12. For free (non-periodic)
problems this is the solution of the package, because all programs have the same influence
coefficients (and agree to 1e-11). For periodic problems it is each program's own solution, except
for programs that would need hours. The CPU time at an error is interpolated between the tolerances
(log-log) and divided by that of the package at the same error. For creep, the pressures at five of
120 instants are compared together; the distances from a run with 16 times as many steps and from
the exact solution of Lee and Radok are also printed.

Adhesion: five states of a rough surface, each solved anew at a given mean gap; pressures are
compared together with those of the package at tolerance 1e-10.

    python benchmarks/peers/compare.py [PROBLEM ...] [--programs NAME ...] [--points] [--rounds N]
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from build import PACKAGES, python_of
from climbing import Climb, Reading, Rungs, distance, in_columns, readings, verdict
from problems import PROBLEMS, RECORDED, STEPS, SharedProblem

import viscontact as vc

HERE = Path(__file__).resolve().parent
TARGETS = (1e-6, 1e-8)
LADDER = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
#: One more tolerance, for programs whose error is smaller than their tolerance.
OUR_LADDER = (*LADDER, 1e-11)
#: For slow programs: times between are interpolated. If one solution takes minutes, only one
#: tolerance is used, and the times are compared at its error.
SHORT_LADDER, ONE_RUNG = (1e-5, 1e-7, 1e-9), (1e-7,)
#: Number of cells, times steps, above which one tolerance is used.
MANY = 2**20
TIGHTEST, TIGHTEST_ADHESIVE = 1e-12, 1e-10
OURS = "viscontact"
FULL = (
    "sphere512",
    "sphere1024",
    "roller",
    "rough-free",
    "rough-ball",
    "rough-periodic",
    "zener256",
    "zener512",
    "sticky",
)

#: Limit all thread pools to one thread.
ONE_THREAD = {f"{name}_NUM_THREADS": "1" for name in ("OMP", "OPENBLAS", "MKL", "NUMBA")}


@dataclass(frozen=True)
class Program:
    """A program, with one way of using it."""

    name: str
    driver: str
    arguments: tuple[str, ...] = ()
    creep: bool | None = None  # None: both kinds
    any_cells: bool = True
    adheres: bool = False
    ladder: tuple[float, ...] = LADDER

    def takes(self, problem: SharedProblem) -> str:
        """Reason why it cannot solve the problem; empty if it can."""
        if problem.adhesion is not None and not self.adheres:
            return "-"
        if self.creep is not None and problem.creeps != self.creep:
            return "-"
        if not self.any_cells and not problem.square_cells:
            return "only square grids of square cells"
        if self.name == OURS and problem.name.startswith("free rough"):
            return "-"  # it refuses contact at the border; its solver is in the row below
        return ""

    def ladder_for(self, problem: SharedProblem) -> tuple[float, ...]:
        """Tolerances for this program and problem."""
        cells = problem.shape[0] * problem.shape[1] * (STEPS if problem.creeps else 1)
        if problem.adhesion is not None:
            return tuple(each for each in self.ladder if each >= TIGHTEST_ADHESIVE)
        return ONE_RUNG if self.ladder is SHORT_LADDER and cells >= MANY else self.ladder

    @property
    def python(self) -> Path:
        return Path(sys.executable) if self.driver == OURS else python_of(self.driver)


PROGRAMS = (
    Program(OURS, OURS, ("{problem}",), ladder=OUR_LADDER),
    Program(f"{OURS}, solver", OURS, creep=False, adheres=True, ladder=OUR_LADDER),
    Program("ASPHER", "aspher", any_cells=False),
    Program("tamaas", "tamaas", adheres=True, ladder=SHORT_LADDER),
    Program("tamaas, Maxwell", "tamaas", ("maxwell",), creep=True, ladder=(1e-5,)),
    Program("ContactMechanics", "contactmechanics", creep=False, ladder=SHORT_LADDER),
)


def climb(
    program: Program, name: str, problem: SharedProblem, tolerances: tuple[float, ...], limit: float
) -> Climb | str:
    """Run a driver and return its results, or the reason for their absence."""
    with tempfile.TemporaryDirectory() as directory:
        given, found = Path(directory) / "problem.npz", Path(directory) / "result.npz"
        arrays = problem.arrays()
        arrays["tolerances"] = np.array(tolerances)
        arrays["repeats"], arrays["budget"] = np.array(5), np.array(3.0)
        arrays["displacement_scale"] = np.array(_displacement(problem))
        np.savez(given, **arrays)
        driver = HERE / f"driver_{program.driver}.py"
        arguments = [argument.format(problem=name) for argument in program.arguments]
        command = [str(program.python), str(driver), str(given), str(found), *arguments]
        environment = os.environ | ONE_THREAD
        if program.driver != OURS:
            environment.pop("PYTHONPATH", None)
        try:
            done = subprocess.run(
                command, env=environment, text=True, capture_output=True, timeout=limit, check=False
            )
        except subprocess.TimeoutExpired:
            return f"no answer within {limit:g} s"
        if done.returncode or not found.exists():
            return (done.stderr.strip().splitlines() or ["no reason given"])[-1]
        result = np.load(found)
        if not len(result["tolerances"]):
            return done.stderr.strip().splitlines()[-1]
        names = ("tolerances", "pressures", "cpu", "wall")
        return Climb(str(result["version"]), *(result[each] for each in names))


def _displacement(problem: SharedProblem) -> float:
    """Approximate largest displacement [m], for a program whose tolerance is a length."""
    force, (along, across) = problem.force, problem.size
    if problem.adhesion is not None:
        return problem.adhesion[1]
    return force / max(along, across)  # u = F/(pi E* r), a contact's width from the force


def truth_of(name: str, problem: SharedProblem, limit: float) -> np.ndarray | None:
    """Solution of the package at the tightest tolerance."""
    for program in PROGRAMS[:2]:
        if not program.takes(problem):
            tightest = TIGHTEST if problem.adhesion is None else TIGHTEST_ADHESIVE
            found = climb(program, name, problem, (tightest,), limit)
            if isinstance(found, Climb):
                return found.pressures[0]
    return None


def in_more_steps(problem: SharedProblem, times: int = 16) -> np.ndarray:
    """Pressures at the recorded instants, computed by the package in more steps."""
    load = vc.step(problem.force, tilt_x=0.0, tilt_y=0.0)
    instants = vc.uniform_times(float(STEPS), STEPS * times)
    grid = vc.Grid(problem.shape, problem.size)
    case = (problem.indenter, problem.material, load, grid, instants)
    states = enumerate(vc.march(*case, tolerance=1e-9))
    wanted = {step * times for step in RECORDED}
    return np.stack([state.pressure for step, state in states if step in wanted])


def exact(problem: SharedProblem) -> np.ndarray:
    """Lee and Radok's pressures at the recorded instants and the cell centres."""
    compliance = problem.material.contact_compliance()
    arrays = problem.arrays()

    def modulus(t: np.ndarray) -> np.ndarray:
        branches = zip(arrays["moduli"], arrays["maxwell_times"], strict=True)
        return arrays["equilibrium_modulus"] + sum(m * np.exp(-t / tau) for m, tau in branches)

    contact = vc.reference.lee_radok_step(problem.force, 1.0, compliance, modulus)
    x, y = problem.centres()
    r = np.hypot(x[:, None], y[None, :])
    # Smooth in r² except at the contact edge: thousands of radii are as accurate as all cells.
    radii = np.linspace(0.0, r.max(), 4001)
    return np.stack([np.interp(r, radii, contact.pressure(radii, float(t))) for t in RECORDED])


def compare(
    name: str, programs: list[Program], limit: float, *, points: bool, rounds: int = 1
) -> str:
    """Print the table of a problem, and return the outcome in one line."""
    problem = PROBLEMS[name]()
    print(f"\n{problem.name}", flush=True)
    truth = truth_of(name, problem, limit)
    far = (in_more_steps(problem), exact(problem)) if problem.creeps else ()
    heading = "  ".join(f"{'CPU s':>8} {'ratio':>7} {f'{target:.0e}':9}" for target in TARGETS)
    print(f"{'':20} {heading}" + ("  16x steps    exact" if far else ""))
    ours: Rungs | None = None
    peers: dict[str, list[Reading]] = {}
    results = in_turns(programs, name, problem, limit, truth, rounds)
    for program, (found, own) in results.items():
        if found is None:
            continue
        if isinstance(found, str):
            print(f"{program.name:20} {found}", flush=True)
            continue
        rungs = found.against(found.pressures[-1] if own or truth is None else truth)
        ours = ours or rungs
        read = readings(rungs, ours, TARGETS)
        if program.driver != OURS:
            peers[program.name] = read
        line = f"{program.name:20} {in_columns(read, TARGETS)}"
        line += "".join(f" {distance(found.pressures[-1], other):10.2e}" for other in far)
        print(f"{line} {found.version}", flush=True)
        if points:
            print_points(rungs)
    said = verdict(OURS, peers) or "nothing to compare with"
    print(said, flush=True)
    return f"{problem.name:24} {said}"


def in_turns(
    programs: list[Program],
    name: str,
    problem: SharedProblem,
    limit: float,
    truth: np.ndarray | None,
    rounds: int,
) -> dict[Program, tuple[Climb | str | None, bool]]:
    """Results of programs that run in turns, with their least times, and if each is its truth."""
    results: dict[Program, tuple[Climb | str | None, bool]] = {}
    for _ in range(rounds):
        for program in programs:
            # With adhesion no other program reaches the tightest tolerance.
            turned = problem.periodic and problem.adhesion is None
            own = truth is None or (turned and program.ladder_for(problem) != ONE_RUNG)
            found = reached(program, name, problem, limit, own=own)
            earlier = results.get(program, (None, own))[0]
            if isinstance(found, Climb) and isinstance(earlier, Climb):
                found = replace(found, cpu=np.minimum(found.cpu, earlier.cpu))
            results[program] = found, own
    return results


def reached(
    program: Program, name: str, problem: SharedProblem, limit: float, *, own: bool
) -> Climb | str | None:
    """Results of a program, or the reason for their absence; None if it does not apply."""
    why = program.takes(problem)
    if why == "-":
        return None
    if why:
        return why
    if not program.python.exists():
        return "not built: ./go bench build-peers"
    ladder = program.ladder_for(problem)
    return climb(program, name, problem, (*ladder, TIGHTEST) if own else ladder, limit)


def print_points(rungs: Rungs) -> None:
    for error, cpu in zip(rungs.errors[::-1], rungs.cpu[::-1], strict=True):
        print(f"{'':20} error {error:8.1e}: {cpu:.3f} s")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", default=FULL, help=", ".join(PROBLEMS))
    parser.add_argument("--programs", nargs="+", help=", ".join(p.name for p in PROGRAMS))
    parser.add_argument("--points", action="store_true", help="print the ladder, rung by rung")
    parser.add_argument("--limit", type=float, default=900.0, help="seconds for one program")
    parser.add_argument("--rounds", type=int, default=1, help="turns of the programs")
    options = parser.parse_args()
    if unknown := [name for name in options.problems if name not in PROBLEMS]:
        parser.error(f"no problem is called {', '.join(unknown)}; there are {', '.join(PROBLEMS)}")
    wanted = [p for p in PROGRAMS if not options.programs or p.name in options.programs]
    print(f"one thread; peers that can be built: {', '.join(PACKAGES)}")
    said = [
        compare(name, wanted, options.limit, points=options.points, rounds=options.rounds)
        for name in options.problems
    ]
    print("\nall of them\n" + "\n".join(said))


if __name__ == "__main__":
    main()
