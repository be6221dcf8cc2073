"""Stresses below a pressure or a traction that is periodic along both axes, wave by wave.

Each wave of the load has its own stresses, by `StressResponse.tensors`.
"""

from __future__ import annotations

import numpy as np
import scipy

from viscontact.backend.arrays import Complexes, Floats, Numbers
from viscontact.backend.transforms import as_reals
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.stress_lines import ODD_ACROSS, Progress
from viscontact.mechanics.halfspace.stress_response import StressResponse


def waves_on_section(
    loads: Floats,
    grid: Grid,
    depths: Floats,
    response: StressResponse,
    y: float,
    progress: Progress | None = None,
) -> Floats:
    """Stresses on the plane of y [m], shape (6, fields, depths, nx), by fields of the load."""
    # Waves along the section by a transform, across it by a sum of both directions at once: their
    # stresses are equal, up to the sign of those that are odd across it.
    (nx, ny), (dx, dy) = grid.shape, grid.cell_size
    along = 2 * np.pi * scipy.fft.rfftfreq(nx, dx)[:, None]
    across = 2 * np.pi * scipy.fft.rfftfreq(ny, dy)[None, :]
    even, odd = _both_directions(loads, y - grid.y[0], across[0])
    if response.axis == 1:
        even, odd = odd, even
    at = response.tensors(along, across)
    found = np.empty((6, len(loads), len(depths), nx))
    for index, depth in enumerate(depths.tolist()):
        sums = [
            phase * _sum_waves(each, odd if place in ODD_ACROSS else even)
            for place, (phase, each) in enumerate(zip(response.phases, at(depth), strict=True))
        ]
        found[:, :, index] = scipy.fft.irfft(np.stack(sums), nx, axis=1).swapaxes(1, 2)
        if progress is not None:
            progress(index + 1, len(depths))
    return found


def waves_on_plane(loads: Floats, grid: Grid, depth: float, response: StressResponse) -> Numbers:
    """Stresses on the plane of a depth [m], shape (6, fields, nx, ny), by fields of the load."""
    along = 2 * np.pi * scipy.fft.fftfreq(grid.shape[0], grid.cell_size[0])[:, None]
    across = 2 * np.pi * scipy.fft.fftfreq(grid.shape[1], grid.cell_size[1])[None, :]
    own = np.stack(
        [
            phase * each
            for phase, each in zip(
                response.phases, response.tensors(along, across)(depth), strict=True
            )
        ]
    )
    found = np.empty((6, *loads.shape))
    for place, field in enumerate(loads):
        found[:, place] = scipy.fft.ifft2(own * scipy.fft.fft2(field)).real
    return found


def _both_directions(pressure: Floats, offset: float, across: Floats) -> tuple[Floats, Floats]:
    """Sum and difference of waves of ky and -ky at `offset` [m], shape (fields, kx, ky, 2)."""
    ny = pressure.shape[2]
    spectrum = scipy.fft.fft(scipy.fft.rfft(pressure, axis=1), axis=2) / ny
    kept = np.arange(across.size)
    phase = np.exp(1j * across * offset)
    # The mean across and the shortest wave have one direction.
    phase[[0, *([-1] if ny % 2 == 0 else [])]] /= 2
    one, other = spectrum[:, :, kept] * phase, spectrum[:, :, -kept % ny] * phase.conj()
    even, odd = (np.ascontiguousarray(each) for each in (one + other, one - other))
    return as_reals(even), as_reals(odd)


def _sum_waves(weights: Floats, waves: Floats) -> Complexes:
    """Sums over the waves across the section; (kx, fields)."""
    sums = np.einsum("ky,fkyr->kfr", weights, waves)
    return np.ascontiguousarray(sums).view(np.complex128)[..., 0]
