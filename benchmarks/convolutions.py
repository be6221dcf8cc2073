"""CPU time [ms] of one convolution: free, halved, quartered, in single precision, by library.

python benchmarks/convolutions.py [--cells 128 256 512 1024]
"""

from __future__ import annotations

import argparse
from collections.abc import Callable

import numpy as np
from run import reference_convolution, seconds_of

from viscontact.backend.transforms import Transforms, transforms_by
from viscontact.mechanics.halfspace.convolution import Convolution
from viscontact.mechanics.halfspace.influence import influence_table
from viscontact.mechanics.halfspace.preconditioner import Preconditioner

REPEATS = 40
MIRRORED = ((False, False), (False, True), (True, True))


def least(act: Callable[[], object]) -> float:
    """Minimum CPU time [ms] of many calls."""
    act()
    return 1e3 * min(seconds_of(act) for _ in range(REPEATS))


def costs(cells: int, transforms: Transforms) -> list[float]:
    """CPU times [ms]: free, halved, quartered, each in double and single; a preconditioner."""
    table = influence_table((cells, cells), (1.0, 1.0))
    found = []
    for mirrored in MIRRORED:
        for single in (False, True):
            operator = Convolution(table, mirrored=mirrored, single=single, transforms=transforms)
            field = np.random.default_rng(1).random(operator.shape)
            found.append(least(lambda at=operator, field=field: at.apply(field)))
    half = (cells, cells // 2)
    rough = Preconditioner(half, (1.0, 1.0), mirrored=(False, True), transforms=transforms)
    field = np.random.default_rng(1).random(half)
    return [*found, least(lambda: rough.apply(field))]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cells", type=int, nargs="+", default=[128, 256, 512, 1024])
    print(
        "cells  library  reference  free 64  free 32  half 64  half 32  quarter 64  32   precond."
    )
    for cells in parser.parse_args().cells:
        for library in ("scipy", "ducc0"):
            try:
                transforms = transforms_by(library)
            except ValueError:
                continue
            reference = least(reference_convolution((cells, cells)))
            line = " ".join(f"{cost:8.2f}" for cost in [reference, *costs(cells, transforms)])
            print(f"{cells:4}²  {library:7} {line}", flush=True)


if __name__ == "__main__":
    main()
