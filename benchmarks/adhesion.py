"""Cost of adhesion: the same run with and without it, in turn, and the convolutions of both.

A sphere is pressed and withdrawn by a stage, on an elastic and on a creeping body, and a rough
surface that repeats is pressed and withdrawn. The instants are given; a run with adhesion takes
further steps between them where its force changes much. The transforms are SciPy's. Prints the CPU
time of each, their ratio in the median of the repetitions, steps, convolutions of bodies without a
period, and preconditioners, those on patches by their part of the grid.

    python benchmarks/adhesion.py [--repeat 3] [--steps 100]
"""

from __future__ import annotations

import argparse
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any
from unittest.mock import patch

import numpy as np

import viscontact as vc
from viscontact.backend import transforms
from viscontact.mechanics.contact.patch import PatchOperators
from viscontact.mechanics.halfspace.convolution import Convolution
from viscontact.mechanics.halfspace.preconditioner import Preconditioner
from viscontact.simulation.transient.stepper import Stepper

#: Radius [m], compliance [1/Pa] and work of adhesion [J/m²] of the spheres.
RADIUS, COMPLIANCE, WORK = 1e-5, 4e-7, 0.05

#: Units of contact radius and of approach (Maugis 1992), and range of the Tabor number 1 [m].
LENGTH = float(np.cbrt(0.75 * np.pi * WORK * RADIUS**2 * COMPLIANCE))
DEPTH = LENGTH**2 / RADIUS
RANGE = float(np.cbrt(RADIUS * (WORK * COMPLIANCE) ** 2))

#: Shear modulus of the body at rest, and what it is stiffer at once.
MODULUS, STIFFENING = 0.25 / COMPLIANCE, 3.0


@dataclass(frozen=True)
class Bench:
    """A run, with what makes its bodies adhere."""

    name: str
    arguments: tuple[Any, ...]
    adhesion: vc.Adhesion


def sphere(law: vc.Law, name: str, steps: int) -> Bench:
    """Sphere on a body of 128² cells that is pressed, and withdrawn until it is apart."""
    grid = vc.Grid((128, 128), (9 * LENGTH, 9 * LENGTH))
    load = vc.ApproachHistory([0.0, 1.0, 3.0], np.array([0.0, 3.0, -3.0]) * DEPTH)
    material = vc.Material(law, poisson_ratio=0.5)
    given = vc.Paraboloid(RADIUS, RADIUS), material, load, grid, vc.uniform_times(3.0, steps)
    return Bench(name, given, vc.Adhesion(WORK, range=RANGE))


def rough(steps: int, cells: int = 256) -> Bench:
    """Surface that repeats, pressed to a third of contact and withdrawn.

    Self-affine of Hurst exponent 0.8 and slope 0.1, with 2 to 32 waves on its side of 1 mm.
    """
    side, modulus = 1e-3, 1 / COMPLIANCE
    waves = np.hypot(*np.meshgrid(*[np.fft.fftfreq(cells, 1 / cells)] * 2, indexing="ij"))
    size = np.zeros_like(waves)
    held = (waves >= 2) & (waves <= 32)
    size[held] = waves[held] ** -1.8
    noise = np.fft.fft2(np.random.default_rng(1).standard_normal(waves.shape))
    heights = np.fft.ifft2(noise / np.abs(noise) * size).real
    slopes = [np.diff(heights, axis=axis, append=heights.take([0], axis)) for axis in (0, 1)]
    heights *= 0.1 * side / cells / np.sqrt(np.mean(np.square(slopes).sum(axis=0)))
    places = (np.arange(cells) + 0.5) * side / cells - side / 2
    body, rms = vc.HeightMap(places, places, -heights), float(heights.std())
    material = vc.Material(vc.Elastic(0.25 * modulus), poisson_ratio=0.5)
    levels = (np.array([-3.0, -0.7, -3.0]) * rms) + float(heights.max())
    load = vc.ApproachHistory([0.0, 1.0, 2.0], levels)
    grid = vc.Grid((cells, cells), (side, side), periodic=True)
    given = body, material, load, grid, vc.uniform_times(2.0, steps)
    return Bench("rough, periodic", given, vc.Adhesion(6e-5 * modulus * side, range=3e-3 * side))


def marched(bench: Bench, *, adheres: bool) -> int:
    """Number of steps of a run, the ones between its instants, too."""
    taken = []
    accept = Stepper.accept

    def counted(self: Stepper, *given: Any) -> Any:
        taken.append(None)
        return accept(self, *given)

    with patch.object(Stepper, "accept", counted):
        for _ in vc.march(*bench.arguments, adhesion=bench.adhesion if adheres else None):
            pass
    return len(taken)


def seconds(bench: Bench, *, adheres: bool) -> float:
    """CPU time of a run [s]."""
    begin = time.process_time()
    marched(bench, adheres=adheres)
    return time.process_time() - begin


def counted(bench: Bench, *, adheres: bool) -> tuple[int, float, float]:
    """Steps of a run; cells convolved and preconditioned in it, in those of its grid."""
    cells, most = {"convolved": 0, "preconditioned": 0}, 0

    def counting(owner: type, name: str) -> Any:
        apply = owner.apply

        def count(self: Any, field: Any, *given: Any, **how: Any) -> Any:
            nonlocal most
            most = max(most, field.size)
            cells[name] += field.size
            return apply(self, field, *given, **how)

        return patch.object(owner, "apply", count)

    with (
        counting(Convolution, "convolved"),
        counting(Preconditioner, "preconditioned"),
        patch.object(PatchOperators, "compiled", None),  # not several in one call of the core
    ):
        steps = marched(bench, adheres=adheres)
    return steps, cells["convolved"] / most, cells["preconditioned"] / most


def benches(steps: int) -> list[Callable[[], Bench]]:
    """What is run."""
    creeping = vc.Zener(MODULUS * STIFFENING, MODULUS / (1 - 1 / STIFFENING), 1.5 * MODULUS)
    return [
        lambda: sphere(vc.Elastic(MODULUS), "sphere, elastic", steps),
        lambda: sphere(creeping, "sphere, creeping", steps),
        lambda: rough(steps),
    ]


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--steps", type=int, default=100)
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    print(
        "                     without                            with\n"
        "run                  CPU s  steps  convolutions  prec.  CPU s  steps  convolutions"
        "  prec.  ratio"
    )
    with patch.object(transforms, "ducc0", None):
        for make in benches(given.steps):
            bench = make()
            counts = [counted(bench, adheres=adheres) for adheres in (False, True)]
            pairs = [
                [seconds(bench, adheres=adheres) for adheres in (False, True)]
                for _ in range(given.repeat)
            ]
            ratio = float(np.median([both / one for one, both in pairs]))
            texts = [
                f"{taken:6.2f} {steps:6} {convolved:13.0f} {smoothed:6.0f}"
                for taken, (steps, convolved, smoothed) in zip(
                    np.median(pairs, axis=0), counts, strict=True
                )
            ]
            print(f"{bench.name:20}{texts[0]} {texts[1]} {ratio:6.2f}", flush=True)


if __name__ == "__main__":
    main()
