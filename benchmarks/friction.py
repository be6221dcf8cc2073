"""Cost of friction: the same run with and without it, in turn, and the convolutions of both.

A sphere on a Zener body, pressed for 2 s and pulled to and fro by a third of what friction carries.
The body is incompressible (nu = 1/2), so that the normal contact does not feel the tractions, or of
another Poisson's ratio, and coupled. The contact spans 85 % of the grid of 5 mm. The transforms are
SciPy's. Prints the CPU time of each, their ratio in the median of the repetitions, and for a step
the convolutions and preconditioners of the normal contact, of one field, and of the tractions, of
two.

    python benchmarks/friction.py [--cells 64 128 256] [--repeat 3] [--poisson 0.5] [--size 5]
"""

from __future__ import annotations

import argparse
import time
import warnings
from dataclasses import dataclass
from typing import Any
from unittest.mock import patch

import numpy as np

import viscontact as vc
from viscontact.backend import transforms
from viscontact.mechanics.contact.patch import PatchOperators
from viscontact.mechanics.halfspace.convolution import Convolution
from viscontact.mechanics.halfspace.halved_shear import HalvedShearFilter
from viscontact.mechanics.halfspace.mirrored_shear import MirroredShearFilter
from viscontact.mechanics.halfspace.preconditioner import Preconditioner
from viscontact.mechanics.halfspace.shear_filter import ShearFilter

FORCE, COEFFICIENT, CYCLES = 10.0, 0.3, 2
LAW = vc.Zener(4e6, 8e6, 4e6)


@dataclass(frozen=True)
class Bench:
    """A run on a number of cells along each axis."""

    cells: int
    poisson_ratio: float
    size: float  # of the grid [m]


def marched(bench: Bench, *, grips: bool) -> int:
    """Number of steps of a run."""
    corners = [2.0, *(2.5 + np.arange(2 * CYCLES + 1))]
    signs = np.array([0.0, *(1 - 2 * (np.arange(2 * CYCLES + 1) % 2))])
    pull = vc.TangentialHistory(corners, force_x=COEFFICIENT * FORCE / 3 * signs)
    times = np.append(np.linspace(0, 2, 9), np.arange(2.25, corners[-1] + 0.1, 0.25))
    grip: dict[str, Any] = {"friction": COEFFICIENT, "tangential": pull} if grips else {}
    states = vc.march(
        vc.Sphere(0.01),
        vc.Material(LAW, bench.poisson_ratio),
        vc.step(FORCE),
        vc.Grid((bench.cells, bench.cells), (bench.size, bench.size)),
        times,
        **grip,
    )
    return sum(1 for _ in states)


def seconds(bench: Bench, *, grips: bool) -> float:
    """CPU time of a run [s]."""
    begin = time.process_time()
    marched(bench, grips=grips)
    return time.process_time() - begin


def counted(bench: Bench, *, grips: bool) -> tuple[float, float]:
    """Applied filters of a step: of one field, and of pairs of fields."""
    counts = {"one": 0, "two": 0}

    def counting(owner: type, name: str) -> Any:
        apply = owner.apply

        def count(self: Any, *given: Any, **how: Any) -> Any:
            counts[name] += 1
            return apply(self, *given, **how)

        return patch.object(owner, "apply", count)

    with (
        counting(ShearFilter, "two"),
        counting(HalvedShearFilter, "two"),
        counting(MirroredShearFilter, "two"),
        counting(Convolution, "one"),
        counting(Preconditioner, "one"),
        patch.object(PatchOperators, "compiled", None),  # not several in one call of the core
    ):
        steps = marched(bench, grips=grips)
    return counts["one"] / steps, counts["two"] / steps


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cells", type=int, nargs="+", default=[64, 128, 256])
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--poisson", type=float, default=0.5)
    parser.add_argument("--size", type=float, default=5.0, help="of the grid [mm]")
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    print("cells  without [s]  with [s]  ratio  one field/step  two fields/step")
    with patch.object(transforms, "ducc0", None):
        for cells in given.cells:
            bench = Bench(cells, given.poisson, 1e-3 * given.size)
            marched(bench, grips=True)  # imports, tables
            pairs = [
                (seconds(bench, grips=False), seconds(bench, grips=True))
                for _ in range(given.repeat)
            ]
            without, with_friction = np.median(pairs, axis=0)
            ratio = float(np.median([both / one for one, both in pairs]))
            one, two = counted(bench, grips=True)
            times = f"{without:11.2f} {with_friction:9.2f} {ratio:6.2f}"
            print(f"{cells:5} {times} {one:12.1f} {two:16.1f}")


if __name__ == "__main__":
    main()
