"""Subsurface stresses of a half-space or of layers under a load on the surface.

With a constant Poisson's ratio the stresses of a viscoelastic half-space under pressure and shear
traction are the elastic ones: they do not depend on the modulus, hence on the current load only
(Lee 1955, correspondence principle).
"""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.periodic_stress import periodic_stress_coefficients
from viscontact.mechanics.halfspace.stress_influence import COMPONENTS, EXCHANGED
from viscontact.mechanics.halfspace.stress_lines import (
    SURFACE,
    Progress,
    along_lines,
    part_of,
)
from viscontact.mechanics.halfspace.stress_response import HalfSpaceStress, StressResponse
from viscontact.mechanics.halfspace.stress_waves import waves_on_plane, waves_on_section

#: Most memory of the transforms of fields whose stresses are computed together [bytes].
TOGETHER = 100e6


@dataclass(frozen=True, eq=False)
class Stress:
    """Stress tensors at points: components xx, yy, zz, yz, xz, xy, tension positive [Pa].

    NaN where there is no body.
    """

    components: Floats

    def __getitem__(self, name: str) -> Floats:
        """A component by name, such as ``"zz"`` [Pa]."""
        component: Floats = self.components[COMPONENTS.index(name)]
        return component

    @property
    def von_mises(self) -> Floats:
        """Von Mises equivalent stress [Pa], shape (...)."""
        xx, yy, zz, yz, xz, xy = self.components
        normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
        return np.asarray(np.sqrt(normal / 2 + 3 * (yz**2 + xz**2 + xy**2)))

    @property
    def principal(self) -> Floats:
        """Principal stresses in descending order [Pa], shape (3, ...)."""
        xx, yy, zz, yz, xz, xy = self.components
        rows = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
        tensors = np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
        known = np.isfinite(tensors).all(axis=(-2, -1))
        tensors[~known] = 0.0
        found = np.moveaxis(np.linalg.eigvalsh(tensors)[..., ::-1], -1, 0)
        return np.where(known, found, np.nan)

    @property
    def max_shear(self) -> Floats:
        """Largest shear stress over all planes, half the difference of principal stresses [Pa]."""
        principal = self.principal
        return np.asarray((principal[0] - principal[2]) / 2)


def stress_on_section(
    load: Floats,
    grid: Grid,
    depths: ArrayLike,
    body: float | StressResponse,
    *,
    x: float | None = None,
    y: float | None = None,
    progress: Progress | None = None,
) -> Stress:
    """Stress on a vertical plane of given x or y [m]; at the y of the grid's middle if neither is.

    Parameters
    ----------
    load : ndarray, shape (..., nx, ny)
        Pressure on the surface, positive in compression, or the traction on it along one axis,
        as the body says [Pa].
    grid : Grid
        The cells.
    depths : array_like, shape (nz,)
        Depths below the surface, 0 or positive [m].
    body : float or StressResponse
        Poisson's ratio of a half-space under pressure [-], or a body under a kind of load.
    x, y : float, optional
        Position of the plane [m]; the other coordinate runs over the grid's cell centres.
    progress : callable, optional
        Called as ``progress(done, total)`` after each depth.

    Returns
    -------
    Stress
        Components of shape (..., nz, nx) on a plane of given y, (..., nz, ny) on one of given x.

    Raises
    ------
    ValueError
        If both x and y are given, a depth is negative, no number or in a rigid base, or Poisson's
        ratio is not between 0 and 0.5.

    Notes
    -----
    Each line of cells acts on the section as a convolution with Love's closed form
    (`stress_influence`, of layers `layered_stress`, of tractions `shear_stress_influence`), by
    zero-padded fast Fourier transforms (`stress_lines`); exact for loads that are constant within
    cells. On a grid that is periodic
    along one axis the images of a cell are summed (`periodic_stress`). On one that is periodic
    along both, each wave of the load has its own stresses (`stress_waves`): those of a pressure
    have Johnson's (1985, Contact Mechanics, section 13.2), turned to its direction; and the mean
    pressure causes no strain along the surface: σxx = σyy = ν/(1 - ν) σzz.
    """
    response = _response(body)
    below = _check_depths(depths, response)
    if x is not None and y is not None:
        raise ValueError("a section lies at an x or at a y; give one of them")
    if x is not None:
        turned, body = load.swapaxes(-1, -2), response.exchanged
        stress = stress_on_section(turned, _swap(grid), below, body, y=x, progress=progress)
        # x and y are exchanged on the turned grid.
        return Stress(stress.components[EXCHANGED])
    y = grid.centre[1] if y is None else y
    fields = load.reshape(-1, *grid.shape)
    compute = waves_on_section if all(grid.periodic) else along_lines
    # Influence coefficients are the same for all fields: compute many of them together.
    count = max(1, int(TOGETHER / (64 * fields[0].size)))
    parts = [fields[begin : begin + count] for begin in range(0, len(fields), count)]
    found = np.empty((6, len(fields), below.size, grid.shape[0]))
    for index, part in enumerate(parts):
        found[:, index * count : index * count + len(part)] = compute(
            part, grid, below, response, y, part_of(progress, index, len(parts))
        )
    return Stress(found.reshape(6, *load.shape[:-2], *found.shape[2:]))


def stress_on_plane(load: Floats, grid: Grid, depth: float, body: float | StressResponse) -> Stress:
    """Stress on a plane parallel to the surface, at the cell centres, of shape (..., nx, ny)."""
    response = _response(body)
    below = float(_check_depths([depth], response)[0])
    if all(grid.periodic):
        found = waves_on_plane(load.reshape(-1, *grid.shape), grid, below, response)
        return Stress(found.reshape(6, *load.shape))
    if grid.periodic[1]:
        turned = stress_on_plane(load.swapaxes(-1, -2), _swap(grid), below, response.exchanged)
        return Stress(turned.components[EXCHANGED].swapaxes(-1, -2))
    below = max(below, SURFACE * min(grid.cell_size))
    (nx, ny), (dx, dy) = grid.shape, grid.cell_size
    y_edges = (np.arange(-ny + 1, ny + 1, dtype=np.float64) - 0.5) * dy
    if grid.periodic[0]:
        # The edges rise along y, so that the second difference has the other sign.
        first = -(nx // 2) * dx
        kernel = -periodic_stress_coefficients(first, nx, dx, y_edges, below, response)
        kernel, padded = scipy.fft.ifftshift(kernel, axes=1), nx
    else:
        x_edges = (np.arange(-nx + 1, nx + 1, dtype=np.float64) - 0.5) * dx
        kernel = response.coefficients(x_edges, y_edges, below)
        kernel, padded = np.roll(kernel, 1 - nx, axis=1), 2 * nx - 1
    shape = (padded, 2 * ny - 1)
    spectrum = scipy.fft.rfft2(np.roll(kernel, 1 - ny, axis=2), shape)
    own = scipy.fft.rfft2(load, shape)
    found = np.stack([scipy.fft.irfft2(each * own, shape)[..., :nx, :ny] for each in spectrum])
    return Stress(found)


def _swap(grid: Grid) -> Grid:
    """Grid with x and y exchanged."""
    periodic = (grid.periodic[1], grid.periodic[0])
    return Grid(grid.shape[::-1], grid.size[::-1], periodic, centre=grid.centre[::-1])


def _response(body: float | StressResponse) -> StressResponse:
    return body if isinstance(body, StressResponse) else HalfSpaceStress(body)


def _check_depths(depths: ArrayLike, response: StressResponse) -> Floats:
    below = np.atleast_1d(np.asarray(depths, dtype=float))
    if below.ndim != 1 or not (np.isfinite(below) & (below >= 0)).all():
        raise ValueError(f"depths must be numbers of metres, 0 or positive, got {depths!r}")
    for depth in below.tolist():
        if not 0 <= response.poisson_ratio_at(depth) <= 0.5:
            ratio = response.poisson_ratio_at(depth)
            raise ValueError(f"poisson_ratio must lie between 0 and 0.5, got {ratio!r}")
    return below
