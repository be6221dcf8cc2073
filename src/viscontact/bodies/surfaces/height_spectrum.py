"""Power spectrum of a measured surface, averaged over all directions."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.surfaces.pressing import require_complete, require_map
from viscontact.bodies.surfaces.surface import Surface

_BINS_PER_DECADE = 10


@dataclass(frozen=True, eq=False)
class PowerSpectrum:
    """Power spectral density of the heights over the wave number.

    Attributes
    ----------
    wave_number : ndarray, shape (n,)
        Mean wave number 2 pi / wavelength of each bin, ascending [rad/m].
    density : ndarray, shape (n,)
        Density C, averaged over all directions [m^4].
    rms_height : float
        Root of the sum over all waves (Sq of the mean-free, windowed heights) [m].
    """

    wave_number: Floats
    density: Floats
    rms_height: float


def power_spectrum(surface: Surface) -> PowerSpectrum:
    r"""Return the power spectral density of a surface, averaged over all directions.

    Parameters
    ----------
    surface : Surface
        Levelled, and without missing points.

    Returns
    -------
    PowerSpectrum
        Up to the shortest wavelength that both spacings resolve, 10 bins per decade; bins without a
        wave are left out.

    Raises
    ------
    ValueError
        If it is a line scan, or points are missing.

    Notes
    -----
    :math:`C(q) = |\tilde h(q)|^2 / A` with
    :math:`\tilde h(q) = \Delta x \Delta y \sum h e^{-i q \cdot x}` (Jacobs, Junge and Pastewka,
    2017, Surf. Topogr.: Metrol. Prop. 5, 013001), so that
    :math:`\mathrm{Sq}^2 = \int C(q)\, d^2 q / 4 \pi^2`. A surface that is not periodic is
    multiplied by a Hann window along each axis, of mean square 1.

    Examples
    --------
    >>> waves = 1e-7 * np.cos(2 * np.pi * np.arange(64) / 8)[:, None] * np.ones(64)
    >>> spectrum = power_spectrum(Surface(waves, 1e-6, periodic=True))
    >>> round(1e9 * spectrum.rms_height, 2)  # nm: the amplitude over the root of two
    70.71
    """
    waves, along, across = mean_square_waves(surface)
    q = np.hypot(along[:, np.newaxis], across)
    lowest, highest = q[q > 0].min(), np.pi / max(surface.spacing)
    count = max(1, round(_BINS_PER_DECADE * float(np.log10(highest / lowest))))
    # The first edge is just below the lowest wave, so that rounding cannot lose it.
    edges = np.geomspace(lowest * (1 - 1e-9), highest * (1 + 1e-9), count + 1)
    place = np.digitize(q, edges).ravel()
    number = np.bincount(place, minlength=count + 2)[1 : count + 1]
    of_waves, of_q = (
        np.bincount(place, weights=each.ravel(), minlength=count + 2)[1 : count + 1]
        for each in (waves, q)
    )
    found = number > 0
    density = surface.size[0] * surface.size[1] * of_waves[found] / number[found]
    return PowerSpectrum(of_q[found] / number[found], density, float(np.sqrt(waves.sum())))


def mean_square_waves(surface: Surface) -> tuple[Floats, Floats, Floats]:
    """Mean square of each wave [m²], and their wave numbers along x and along y [rad/m].

    Their sum is Sq². ValueError for a line scan, or if points are missing.
    """
    require_map(surface)
    require_complete(surface)
    heights = surface.heights - surface.heights.mean()
    if not surface.periodic:
        heights = heights * _hann(surface.shape[0])[:, np.newaxis] * _hann(surface.shape[1])
        heights = heights - heights.mean()
    waves = np.abs(np.fft.fft2(heights)) ** 2 / heights.size**2
    steps = zip(surface.shape, surface.spacing, strict=True)
    along, across = (np.asarray(2 * np.pi * np.fft.fftfreq(n, step), float) for n, step in steps)
    return waves, along, across


def _hann(count: int) -> Floats:
    window = np.hanning(count + 1)[:-1]
    return np.asarray(window / np.sqrt(np.mean(window**2)), dtype=np.float64)
