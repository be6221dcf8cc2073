"""Stresses on a vertical plane as sums over the lines of cells beside it.

Each line of cells acts on the plane as a convolution along it, by fast Fourier transforms. Half of
the influence coefficients follow from the others: each component is even or odd in the distance
along a line, so that an even one and an odd one are transformed together, as real and imaginary
part, and even or odd in the distance across, so that the loads of two lines at one distance on
either side are added or subtracted before. Under a traction along x those that are even along x
under a pressure are odd, and the reverse; under one along y likewise across.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy

from viscontact.backend.arrays import Complexes, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.transforms import as_reals, fast_length
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.periodic_stress import periodic_stress_coefficients
from viscontact.mechanics.halfspace.stress_influence import EXCHANGED
from viscontact.mechanics.halfspace.stress_response import StressResponse

#: Called with how many depths are done, and of how many.
Progress = Callable[[int, int], None]

#: Depth, as a part of a cell's edge, at which the surface is evaluated: only on the surface itself
#: the stress jumps with the pressure from cell to cell; just below, it takes the mean value.
SURFACE = 1e-6

#: The components by place: xx, yy, zz, yz, xz, xy.
_XX, _YY, _ZZ, _YZ, _XZ, _XY = range(6)

#: Components of each transform, even in x under a pressure; the first two share theirs with one odd
#: in x.
_EVEN, _ODD = [_XX, _YY, _ZZ, _YZ], [_XZ, _XY]

#: Components that are odd across the lines under a pressure.
ODD_ACROSS = (_YZ, _XY)

#: Distance in cells by which lines may miss being symmetric to the plane, from rounding.
_ALIGNED = 1e-7


def along_lines(
    loads: Floats,
    grid: Grid,
    depths: Floats,
    response: StressResponse,
    y: float,
    progress: Progress | None = None,
) -> Floats:
    """Stresses on the plane of y [m], (6, fields, depths, nx); not periodic along both axes."""
    lines = _lines_beside(loads, grid, y)
    cells, (dx, dy) = grid.shape[0], grid.cell_size
    columns = np.flatnonzero(lines.even.any(axis=(0, 2)) | lines.odd.any(axis=(0, 2)))
    found = np.zeros((6, len(loads), len(depths), cells))
    if not columns.size:
        return found
    if grid.periodic[0]:
        begin, end, reach, padded = 0, cells, cells // 2, cells
    else:
        # Circular from the first loaded column on, with room for the farthest distance either way.
        begin, end = int(columns[0]), int(columns[-1]) + 1
        reach = max(end, cells - begin) - 1
        padded = fast_length(2 * reach + 1)
    even, odd = (_spectra(field[:, begin:end], padded) for field in (lines.even, lines.odd))
    if response.axis == 1:
        even, odd = odd, even
    places = (np.arange(cells) - begin) % padded
    for index, depth in enumerate(np.maximum(depths, SURFACE * min(dx, dy)).tolist()):
        kernel = _kernel(grid, lines, reach, depth, response)
        is_turned = response.axis == 0
        spectra = _transform(kernel, padded, is_turned=is_turned)
        sums = np.stack(_products(spectra, even, odd, is_turned=is_turned))
        found[:, :, index] = scipy.fft.irfft(sums, padded, axis=1)[:, places].swapaxes(1, 2)
        if progress is not None:
            progress(index + 1, len(depths))
    return found


def part_of(progress: Progress | None, index: int, count: int) -> Progress | None:
    """Progress of one of some equal parts."""
    if progress is None:
        return None
    return lambda done, total: progress(index * total + done, count * total)


@dataclass(frozen=True, eq=False)
class _LinesByDistance:
    """Lines of cells by ascending distance from a plane, those of one distance together."""

    distances: Floats  # [m], of the plane from the lines; equally spaced
    even: Floats  # sum of the loads of both sides, shape (fields, nx, lines) [Pa]
    odd: Floats  # difference of the loads of both sides [Pa]


def _lines_beside(loads: Floats, grid: Grid, y: float) -> _LinesByDistance:
    """Lines of cells beside the plane of given y, without those that bear nothing."""
    count, dy = grid.shape[1], grid.cell_size[1]
    beside = (y - grid.y[0]) / dy
    nearest = int(np.rint(beside))
    part = float(beside - nearest)
    # 1. Lines by ascending distance; of those that repeat, the images within half a period.
    steps = nearest - np.arange(count)
    if grid.periodic[1]:
        steps -= count * np.floor((steps + part) / count + 0.5).astype(int)
    order = np.argsort(steps)
    bearing = np.flatnonzero(np.any(loads[:, :, order] != 0, axis=(0, 1)))
    order = order[bearing[0] : bearing[-1] + 1] if bearing.size else order[:1]
    steps, twice = steps[order], round(2 * part)
    if abs(2 * part - twice) > 2 * _ALIGNED:
        fields = loads[:, :, order]
        return _LinesByDistance(np.asarray((steps + part) * dy), fields, fields)
    # 2. Both sides together, if they are alike.
    halves = 2 * steps + twice
    nearest_half = int(np.abs(halves).min())
    places = (np.abs(halves) - nearest_half) // 2
    even = np.zeros((*loads.shape[:2], int(places.max()) + 1))
    odd = np.zeros_like(even)
    for sign, side in ((1, halves >= 0), (-1, halves < 0)):
        fields = loads[:, :, order[side]]
        even[:, :, places[side]] += fields
        odd[:, :, places[side]] += sign * fields
    return _LinesByDistance((np.arange(even.shape[2]) + nearest_half / 2) * dy, even, odd)


def _kernel(
    grid: Grid, lines: _LinesByDistance, reach: int, depth: float, response: StressResponse
) -> Floats:
    """Stress per unit load at distances of 0 to `reach` cells; (6, reach + 1, lines)."""
    (nx, ny), (dx, dy) = grid.shape, grid.cell_size
    x_edges = (np.arange(reach + 2, dtype=np.float64) - 0.5) * dx
    y_edges = np.append(lines.distances - dy / 2, lines.distances[-1] + dy / 2)
    # Edges that rise instead of falling change the sign of a difference, along both axes twice.
    if grid.periodic[0]:
        return -periodic_stress_coefficients(0.0, nx, dx, y_edges, depth, response, reach + 1)
    if grid.periodic[1]:
        first, count = float(lines.distances[0]), lines.distances.size
        own = response.exchanged
        turned = periodic_stress_coefficients(first, ny, dy, x_edges, depth, own, count)
        return -turned[EXCHANGED].swapaxes(1, 2)
    return response.coefficients(x_edges, y_edges, depth)


def _transform(kernel: Floats, padded: int, *, is_turned: bool) -> Complexes:
    """Transforms along x of the components in pairs, shape (padded // 2 + 1, 4, lines)."""
    last, sign = kernel.shape[1], -1 if is_turned else 1
    whole = np.zeros((padded, 4, kernel.shape[2]))
    # A period of an even number of cells has its middle once.
    again = slice(1, min(last, (padded + 1) // 2))
    mirrored = slice(padded - 1, padded - again.stop, -1)
    for places, parity in ((_EVEN, sign), (_ODD, -sign)):
        part = kernel[places].swapaxes(0, 1)
        once = slice(0, last) if parity > 0 else again  # what is odd is zero at 0
        whole[once, : len(places)] += part[once]
        whole[mirrored, : len(places)] += parity * part[again]
    return np.asarray(scipy.fft.rfft(whole, axis=0, overwrite_x=True))


def _spectra(fields: Floats, padded: int) -> Floats:
    """Transforms along x, complex numbers as pairs; shape (padded // 2 + 1, lines, 2 fields)."""
    spectrum = scipy.fft.rfft(fields, padded, axis=1).transpose(1, 2, 0)
    return as_reals(np.ascontiguousarray(spectrum)).reshape(*spectrum.shape[:2], -1)


def _products(kernel: Complexes, even: Floats, odd: Floats, *, is_turned: bool) -> list[Complexes]:
    """Sums over the lines of the products of the transforms; by component (frequencies, fields)."""
    # An odd part has an imaginary transform.
    parts, factors = [kernel.real, kernel[:, :2].imag], [1, 1j]
    if is_turned:
        parts, factors = [kernel.imag, kernel[:, :2].real], [1j, 1]
    own, others = (np.ascontiguousarray(part) for part in parts)
    normal = factors[0] * (own[:, :3] @ even).view(np.complex128)
    beside = factors[0] * (own[:, 3:] @ odd).view(np.complex128)
    sheared = [
        factors[1] * (others[:, [place]] @ each).view(np.complex128)[:, 0]
        for place, each in ((0, even), (1, odd))
    ]
    return [*normal.swapaxes(0, 1), beside[:, 0], *sheared]
