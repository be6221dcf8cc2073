"""One convolution of each kind, in CPU milliseconds: on the whole grid, mirrored, single, by ducc0.

The ducc0 column is what the mirrored one in double precision would cost with ducc0's transforms in
kept buffers; it is left out where ducc0 cannot be imported. The package does not use it.

    python benchmarks/convolutions.py [--cells 128 256 512 1024]
"""

from __future__ import annotations

import argparse
import importlib
from collections.abc import Callable

import numpy as np
from run import reference_convolution, seconds_of

from viscontact.convolution import Convolution, MirroredConvolution, Preconditioner
from viscontact.influence import influence_table

REPEATS = 40


def least(act: Callable[[], object]) -> float:
    """CPU time [ms] of the fastest of many."""
    act()
    return 1e3 * min(seconds_of(act) for _ in range(REPEATS))


def by_ducc(cells: int) -> Callable[[], object] | None:
    """The transforms of a mirrored convolution by ducc0; None without it."""
    try:
        transforms = importlib.import_module("ducc0").fft
    except ImportError:
        return None
    half = np.zeros((2 * cells, cells // 2))
    spectrum = np.zeros((cells + 1, cells), complex)
    parts = spectrum.view(float).reshape(*spectrum.shape, 2)
    symbol = np.ones(spectrum.shape)

    def convolve() -> None:
        transforms.r2c(half, axes=(0,), out=spectrum[:, : cells // 2])
        spectrum[:, cells // 2 :] = 0
        transforms.dct(parts, type=2, axes=(1,), out=parts)
        np.multiply(spectrum, symbol, out=spectrum)
        transforms.dct(parts, type=3, axes=(1,), out=parts)
        kept = spectrum[:, : cells // 2]
        transforms.c2r(kept, axes=(0,), lastsize=2 * cells, forward=False, out=half)

    return convolve


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cells", type=int, nargs="+", default=[128, 256, 512, 1024])
    print("cells   reference  free 64  free 32  mirrored 64  mirrored 32  precond.  ducc0 64")
    for cells in parser.parse_args().cells:
        table = influence_table((cells, cells), (1.0, 1.0))
        whole = np.random.default_rng(1).random((cells, cells))
        half = np.ascontiguousarray(whole[:, cells // 2 :])
        costs = [least(reference_convolution((cells, cells)))]
        for made, field in ((Convolution, whole), (MirroredConvolution, half)):
            for single in (False, True):
                operator = made(table, single=single)
                costs.append(least(lambda at=operator, field=field: at.apply(field)))
        preconditioner = Preconditioner(half.shape, (1.0, 1.0), mirrored=True)
        costs.append(least(lambda at=preconditioner, field=half: at.apply(field)))
        widths = (9, 8, 8, 12, 12, 9)
        line = " ".join(f"{cost:{width}.2f}" for cost, width in zip(costs, widths, strict=True))
        ducc = by_ducc(cells)
        print(f"{cells:4}² {line} {'-' if ducc is None else f'{least(ducc):9.2f}':>9}", flush=True)


if __name__ == "__main__":
    main()
