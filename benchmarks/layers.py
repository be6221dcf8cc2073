"""Cost of contacts on layers, over that of the same contact on a half-space.

The ball presses layers and half-spaces over the same contact, on the same cells and in the same
steps, in turns; the ratios are medians over the rounds. The set-up (influence coefficients,
separation) is timed apart. The convolutions of elastic contacts are counted for thin and thick
layers.

    python benchmarks/layers.py [--cells 256] [--steps 40] [--rounds 5]
"""

from __future__ import annotations

import argparse
import time
from statistics import median

import numpy as np

import viscontact as vc
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.equilibrium import solve_contact
from viscontact.mechanics.contact.problem import ContactProblem
from viscontact.mechanics.contact.rigid_balance import Constraints
from viscontact.mechanics.halfspace.elastic_stack import ElasticLayer, ElasticStack
from viscontact.mechanics.problem.problem import Problem
from viscontact.reference import layer_sphere
from viscontact.simulation.transient.march import March
from viscontact.simulation.transient.setup import prepare_run

#: Ball, contact radius after the creep, thickness of the layer, and the law, of 1 s.
RADIUS, REACH, THICKNESS = 0.02, 1e-3, 0.5e-3
LAW = vc.Zener(2e6, 1e6, 1e6)
RUBBER = vc.Material(LAW, poisson_ratio=0.45)
STEEL = vc.Material(vc.Elastic(80e9), poisson_ratio=0.3)
HARD = vc.Material(vc.Elastic(4e6), poisson_ratio=0.35)

BODIES: dict[str, vc.Material | vc.Layered] = {
    "half-space": RUBBER,
    "layer on a rigid base": vc.Layered([vc.Layer(THICKNESS, RUBBER)], "rigid"),
    "cover on steel": vc.Layered([vc.Layer(THICKNESS, RUBBER)], STEEL),
    "cover on a core of its stiffness": vc.Layered([vc.Layer(THICKNESS, RUBBER)], HARD),
    "coating on a creeping body": vc.Layered([vc.Layer(THICKNESS, HARD)], RUBBER),
}

#: Most times that a step takes, over one on a half-space; most convolutions of an elastic contact.
PROMISED = {"layer on a rigid base": 1.2, "cover on steel": 1.7}
CONVOLUTIONS = 30

RATIOS, NUS = (0.2, 1.0, 4.0, 8.0, 20.0), (0.3, 0.45, 0.5)


def problem(body: vc.Material | vc.Layered, cells: int, steps: int, *, periodic: bool) -> Problem:
    """The ball under the force that presses it to about the same contact at the end."""
    size = 2.6 * REACH
    grid = vc.Grid((cells, cells), (size, size), periodic=periodic)
    times = vc.log_times(1e-3, 5.0, steps)
    # Hertz's force on the crept half-space; the layers carry more.
    force = 4 * REACH**3 / (3 * RADIUS * float(RUBBER.contact_compliance()(5.0)))
    coarse = vc.Grid((64, 64), (size, size))
    ball = vc.Paraboloid(RADIUS, RADIUS)
    for _ in range(4):  # contact radius to a few per cent
        probe = Problem(ball, body, vc.step(force), coarse, [0.0, 5.0])
        last = list(March(prepare_run(probe), warns=False))[-1]
        assert last is not None
        force *= (REACH / (last.contact_area / np.pi) ** 0.5) ** 3
    return Problem(ball, body, vc.step(force), grid, times)


def seconds_of_steps(posed: Problem) -> tuple[float, float, float]:
    """CPU time of the set-up and of the steps, and iterations of the solver a step."""
    started = time.process_time()
    march = March(prepare_run(posed), warns=False)
    steps = iter(march)
    states = [next(steps)]
    begun = time.process_time()
    states += list(steps)
    passed = time.process_time() - begun
    iterations = float(np.mean([state.iterations for state in states[1:]]))
    return begun - started, passed, iterations


def steps_in_turns(cells: int, steps: int, rounds: int, *, periodic: bool) -> None:
    print(
        f"{cells}² cells{', periodic' if periodic else ''}, {steps} steps: "
        "times over a half-space's"
    )
    posed = {name: problem(body, cells, steps, periodic=periodic) for name, body in BODIES.items()}
    found: dict[str, list[tuple[float, float, float]]] = {name: [] for name in posed}
    for _ in range(rounds):
        for name, each in posed.items():
            found[name].append(seconds_of_steps(each))
    for name, each in posed.items():
        pairs = zip(found[name], found["half-space"], strict=True)
        ratio = median(own[1] / other[1] for own, other in pairs)
        setup, passed, iterations = (median(row[k] for row in found[name]) for k in range(3))
        limit = f", promised {PROMISED[name]}" if name in PROMISED else ""
        print(
            f"  {name:33} {len(each.surface.terms)} terms: {ratio:5.2f}{limit}; "
            f"{1e3 * passed / steps:.1f} ms a step of {iterations:.1f} iterations, "
            f"first step and set-up {setup:.2f} s",
            flush=True,
        )


def elastic_convolutions(cells: int) -> None:
    print(f"convolutions of an elastic contact of {cells} cells per radius to 1e-6, by a/h")
    print("        " + "".join(f"{ratio:7g}" for ratio in RATIOS))
    most = 0
    for nu in NUS:
        line = f"  ν {nu:<4g}"
        for ratio in RATIOS:
            exact = layer_sphere(1.0, 10.0, 1 / ratio, shear_modulus=1.0, poisson_ratio=nu)
            count = 2 * int(1.25 * cells)
            grid = vc.Grid((count, count), (count / cells, count / cells))
            stack = ElasticStack((ElasticLayer(1 / ratio, 1.0, nu),), None)
            domain = ContactDomain(grid, response=stack)
            gap = (grid.x[:, None] ** 2 + grid.y**2) / 20.0
            posed = ContactProblem(gap, (1 - nu) / 2, Constraints((exact.force, 0.0, 0.0)), 1e-15)
            convolutions = solve_contact(posed, domain, tolerance=1e-6).convolutions
            most = max(most, convolutions)
            line += f"{convolutions:7.0f}"
        print(line)
    print(f"  most: {most:.0f}; promised: {CONVOLUTIONS}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cells", type=int, default=256)
    parser.add_argument("--steps", type=int, default=40)
    parser.add_argument("--rounds", type=int, default=5)
    options = parser.parse_args()
    for periodic in (False, True):
        steps_in_turns(options.cells, options.steps, options.rounds, periodic=periodic)
    elastic_convolutions(50)


if __name__ == "__main__":
    main()
