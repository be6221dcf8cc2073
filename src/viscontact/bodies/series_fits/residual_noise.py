"""Spectrum of a fit's residuals, and the covariance of what was fitted under such noise."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.series_fits.quantiles import chi_square_exceedance

_FIRST_BAND = 4  # frequencies of the lowest band, about as many as a fit takes up
_CENTRES = (6.5, 15.5)  # of the next two bands
_STEEPEST = 2.0  # power falls with the frequency to this power at most: that of a random walk
_CHANCE = 1e-3  # with which white noise is taken for another one
_CORRELATED_FREEDOM = 8.0  # of a variance that rests on the lowest band


@dataclass(frozen=True, eq=False)
class Noise:
    """Noise of residuals: white, or stronger at low frequencies.

    The power at each frequency is taken as that of the strongest band from there on, and not less
    than the mean. Where it is no white noise, it is continued to the lowest frequencies: what a fit
    has taken up of slow noise is not seen in its residuals.
    """

    variance: float
    power: Floats  # at each frequency of the real transform of the rows, over the variance [-]
    freedom: float
    is_white: bool

    def covariance(self, influence: Floats) -> Floats:
        """Covariance of unknowns, from the influence of each row on each, shape (p, rows)."""
        rows = influence.shape[1]
        transform = np.fft.rfft(influence, axis=1)
        both = np.full(transform.shape[1], 2.0)  # frequencies of either sign
        both[0] = 1.0
        if rows % 2 == 0:
            both[-1] = 1.0
        weighted = transform * (both * self.power)
        return np.asarray(self.variance / rows * (weighted @ transform.conj().T).real)

    def widening(self, influence: Floats) -> float:
        """Largest ratio of a standard error to that under white noise of the same variance."""
        white = np.einsum("ij,ij->i", influence, influence)
        if self.is_white or self.variance == 0:
            return 1.0
        return float(np.sqrt(np.max(np.diag(self.covariance(influence)) / self.variance / white)))


def noise_of(residuals: Floats, unknowns: int, part: slice | None = None) -> Noise:
    """Noise that residuals show, less the degrees of freedom of the unknowns.

    In a part, such as the rows in contact, the residuals may be of another kind; the stronger
    noise counts.
    """
    rows = residuals.size
    freedom = max(rows - unknowns, 1)
    variance = float(residuals @ residuals) / freedom
    own = np.arange(rows // 2 + 1) / rows
    found = [_power(each, variance) for each in (residuals, *([residuals[part]] if part else []))]
    power = np.max([np.interp(own, each.frequencies, each.power) for each in found], axis=0)
    is_white = all(each.is_white for each in found)
    return Noise(variance, power, freedom if is_white else _CORRELATED_FREEDOM, is_white)


@dataclass(frozen=True, eq=False)
class _Power:
    """Power over a variance [-] at frequencies [per row]."""

    frequencies: Floats
    power: Floats
    is_white: bool


def _power(residuals: Floats, variance: float) -> _Power:
    """Power of residuals: that of each band or of a stronger one above it, at least 1."""
    rows = residuals.size
    count = rows // 2 + 1
    frequencies, power = np.arange(count) / max(rows, 1), np.ones(count)
    if variance == 0 or count < 6 * _FIRST_BAND:
        return _Power(frequencies, power, True)
    spectrum = np.abs(np.fft.rfft(residuals)) ** 2 / (rows * variance)
    bands = _bands(count)
    means = np.array([spectrum[band].mean() for band in bands])
    degrees = [2 * (band.stop - band.start) for band in bands]
    strongest = np.maximum(np.maximum.accumulate(means[::-1])[::-1], 1.0)
    for band, mean in zip(bands, strongest, strict=True):
        power[band] = mean
    power[0] = power[1]
    # A mean over n/2 frequencies is chi-square of n degrees of freedom over n.
    chances = (chi_square_exceedance(*each) for each in zip(means * degrees, degrees, strict=True))
    if all(chance >= _CHANCE / len(bands) for chance in chances):
        return _Power(frequencies, power, True)
    # The fit has taken up most of the lowest band: its power is that of the next one, continued
    # as steeply as that one rises above its successor.
    steepness = np.log(strongest[1] / strongest[2]) / np.log(_CENTRES[1] / _CENTRES[0])
    lowest = np.maximum(np.arange(bands[0].stop), 1)
    continued = strongest[1] * (_CENTRES[0] / lowest) ** np.clip(steepness, 0.0, _STEEPEST)
    power[: bands[0].stop] = np.maximum(continued, strongest[0])
    return _Power(frequencies, power, False)


def _bands(frequencies: int) -> list[slice]:
    """Bands of frequencies above 0: two of the first width, each further one twice as wide."""
    bands, begin, width = [slice(1, 1 + _FIRST_BAND)], 1 + _FIRST_BAND, _FIRST_BAND
    while begin < frequencies:
        end = begin + width if frequencies - begin >= 2 * width else frequencies
        bands.append(slice(begin, end))
        begin, width = end, 4 * width if width == _FIRST_BAND else 2 * width
    return bands
