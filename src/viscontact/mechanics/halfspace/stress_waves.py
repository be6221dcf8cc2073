"""Stresses below a pressure that is periodic along both axes, wave by wave.

Each wave of the pressure has its own stresses (Johnson 1985, Contact Mechanics, section 13.2),
turned to its direction; the mean pressure causes no strain along the surface.
"""

from __future__ import annotations

import numpy as np
import scipy

from viscontact.backend.arrays import Complexes, Floats, Numbers
from viscontact.backend.transforms import as_reals
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.stress_lines import Progress
from viscontact.mechanics.halfspace.stress_response import StressResponse


def waves_on_section(
    pressure: Floats,
    grid: Grid,
    depths: Floats,
    response: StressResponse,
    y: float,
    progress: Progress | None = None,
) -> Floats:
    """Stresses on the plane of y [m], shape (6, fields, depths, nx), by fields of pressure."""
    # Waves along the section by a transform, across it by a sum of both directions at once: their
    # stresses are equal, up to the sign of the components yz and xy.
    (nx, ny), (dx, dy) = grid.shape, grid.cell_size
    along = 2 * np.pi * scipy.fft.rfftfreq(nx, dx)[:, None]
    across = 2 * np.pi * scipy.fft.rfftfreq(ny, dy)[None, :]
    even, odd = _both_directions(pressure, y - grid.y[0], across[0])
    q = np.hypot(along, across)
    q[0, 0] = 1.0  # the mean has no direction; it is set below
    east, north = along / q, across / q
    at = response.waves(q)
    found = np.empty((6, len(pressure), len(depths), nx))
    for index, depth in enumerate(depths.tolist()):
        own = at(depth)
        parts = (own.along, own.across, own.normal, own.shear)
        ahead, aside, normal, shear = (np.asarray(part * own.decay) for part in parts)
        xx, yy = east**2 * ahead + north**2 * aside, north**2 * ahead + east**2 * aside
        lateral = lateral_at_rest(response, depth)
        xx[0, 0] = yy[0, 0] = -lateral
        normal[0, 0] = -1.0
        sums = [
            *(_sum_waves(each, even) for each in (xx, yy, normal)),
            -1j * _sum_waves(north * shear, odd),
            -1j * _sum_waves(east * shear, even),
            _sum_waves(east * north * (ahead - aside), odd),
        ]
        found[:, :, index] = scipy.fft.irfft(np.stack(sums), nx, axis=1).swapaxes(1, 2)
        if progress is not None:
            progress(index + 1, len(depths))
    return found


def waves_on_plane(pressure: Floats, grid: Grid, depth: float, response: StressResponse) -> Numbers:
    """Stresses on the plane of a depth [m], shape (6, fields, nx, ny), by fields of pressure."""
    along = 2 * np.pi * scipy.fft.fftfreq(grid.shape[0], grid.cell_size[0])[:, None]
    across = 2 * np.pi * scipy.fft.fftfreq(grid.shape[1], grid.cell_size[1])[None, :]
    q = np.hypot(along, across)
    q[0, 0] = 1.0  # the mean has no direction; it is set below
    east, north = along / q, across / q
    own = response.waves(q)(depth)
    lateral = lateral_at_rest(response, depth)
    found = np.empty((6, *pressure.shape))
    for place, field in enumerate(pressure):
        spectrum = scipy.fft.fft2(field)
        waves = spectrum * own.decay
        ahead, aside = own.along * waves, own.across * waves
        components = np.stack(
            [
                east**2 * ahead + north**2 * aside,
                north**2 * ahead + east**2 * aside,
                own.normal * waves,
                -1j * north * own.shear * waves,
                -1j * east * own.shear * waves,
                east * north * (ahead - aside),
            ]
        )
        components[:, 0, 0] = -spectrum[0, 0] * np.array([lateral, lateral, 1.0, 0.0, 0.0, 0.0])
        found[:, place] = scipy.fft.ifft2(components).real
    return found


def lateral_at_rest(response: StressResponse, depth: float) -> float:
    """Pressure along the surface per unit mean pressure on it, without strain: ν/(1 - ν) [-]."""
    nu = response.poisson_ratio_at(depth)
    return nu / (1 - nu)


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
