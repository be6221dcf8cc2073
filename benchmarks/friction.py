"""Cost of friction: the same run with and without it, in turn, and the convolutions of both.

A sphere on an incompressible Zener body (nu = 1/2, so uncoupled), pressed for 2 s and pulled to and
fro by a third of what friction carries, which the normal contact does not feel. The transforms are
SciPy's. Prints the CPU time of each, their ratio in the median of the repetitions, and for a step
the convolutions and preconditioners of the normal contact, of one field, and of the tractions, of
two.

    python benchmarks/friction.py [--cells 64 128 256] [--repeat 3]
"""

from __future__ import annotations

import argparse
import time
import warnings
from typing import Any
from unittest.mock import patch

import numpy as np

import viscontact as vc
from viscontact.backend import transforms
from viscontact.mechanics.halfspace.convolution import Convolution
from viscontact.mechanics.halfspace.mirrored_shear import MirroredShearFilter
from viscontact.mechanics.halfspace.preconditioner import Preconditioner
from viscontact.mechanics.halfspace.shear_filter import ShearFilter

FORCE, COEFFICIENT, CYCLES = 10.0, 0.3, 2
LAW = vc.Zener(4e6, 8e6, 4e6)


def marched(cells: int, *, grips: bool) -> int:
    """Number of steps of a run."""
    corners = [2.0, *(2.5 + np.arange(2 * CYCLES + 1))]
    signs = np.array([0.0, *(1 - 2 * (np.arange(2 * CYCLES + 1) % 2))])
    pull = vc.TangentialHistory(corners, force_x=COEFFICIENT * FORCE / 3 * signs)
    times = np.append(np.linspace(0, 2, 9), np.arange(2.25, corners[-1] + 0.1, 0.25))
    grip: dict[str, Any] = {"friction": COEFFICIENT, "tangential": pull} if grips else {}
    states = vc.march(
        vc.Sphere(0.01),
        vc.Material(LAW, 0.5),
        vc.step(FORCE),
        vc.Grid((cells, cells), (5e-3, 5e-3)),
        times,
        **grip,
    )
    return sum(1 for _ in states)


def seconds(cells: int, *, grips: bool) -> float:
    """CPU time of a run [s]."""
    begin = time.process_time()
    marched(cells, grips=grips)
    return time.process_time() - begin


def counted(cells: int, *, grips: bool) -> tuple[float, float]:
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
        counting(MirroredShearFilter, "two"),
        counting(Convolution, "one"),
        counting(Preconditioner, "one"),
    ):
        steps = marched(cells, grips=grips)
    return counts["one"] / steps, counts["two"] / steps


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cells", type=int, nargs="+", default=[64, 128, 256])
    parser.add_argument("--repeat", type=int, default=3)
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    print("cells  without [s]  with [s]  ratio  one field/step  two fields/step")
    with patch.object(transforms, "ducc0", None):
        for cells in given.cells:
            marched(cells, grips=True)  # imports, tables
            pairs = [
                (seconds(cells, grips=False), seconds(cells, grips=True))
                for _ in range(given.repeat)
            ]
            without, with_friction = np.median(pairs, axis=0)
            ratio = float(np.median([both / one for one, both in pairs]))
            one, two = counted(cells, grips=True)
            times = f"{without:11.2f} {with_friction:9.2f} {ratio:6.2f}"
            print(f"{cells:5} {times} {one:12.1f} {two:16.1f}")


if __name__ == "__main__":
    main()
