"""Power that a rolling body turns into heat, at any temperature, from a curve over speed."""

from __future__ import annotations

from functools import cached_property

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import Shift

#: Fewest speeds of a curve.
FEWEST = 4
#: Fall of the error of a cubic spline with twice the points: 2^4, of which half is trusted.
_GAIN = 8.0
#: Relative changes of speed and power that are rounding.
_ROUNDING = 1e-6


@dataclass(frozen=True, eq=False)
class PowerCurve:
    """Resistance over V a_T, the speed times the shift factor.

    The times of a thermorheologically simple law are all multiplied by a_T, so that a steady
    contact at the temperature T and the speed V is that at the temperature of the law and the speed
    V a_T. The resistance is interpolated by a cubic spline of its logarithm, and NaN beyond the
    curve.
    """

    speeds: Floats  # at the temperature of the law, increasing [m/s]
    resistance: Floats  # [N]
    errors: Floats  # of the resistance [N]; NaN where unknown
    shift: Shift  # referred to the temperature of the law

    @cached_property
    def _spline(self) -> scipy.interpolate.CubicSpline:
        return scipy.interpolate.CubicSpline(
            np.log(self.speeds), np.log(self.resistance), extrapolate=False
        )

    def power(self, temperature: Floats, speed: float | Floats) -> Floats:
        """Power at temperatures [K] and speeds [m/s] [W]; NaN beyond the curve."""
        scaled = np.log(speed) + np.log(self.shift.factor(temperature))
        # The ends are of the curve, and rounding may not put them beyond it.
        ends = np.log(self.speeds[[0, -1]])
        for end in ends:
            scaled = np.where(np.isclose(scaled, end, rtol=0, atol=_ROUNDING), end, scaled)
        return np.asarray(speed * np.exp(self._spline(scaled)))

    def power_at_law(self, scaled: Floats) -> Floats:
        """Power at the temperature of the law [W], by the speed there [m/s]."""
        return np.asarray(scaled * np.exp(self._spline(np.log(scaled))))

    @cached_property
    def grows(self) -> bool:
        """True if the power at a constant temperature does not fall with the speed."""
        # In fast motion it tends to a constant, around which the spline swings by its error.
        power = self.power_at_law(self.samples)
        swing = np.nan_to_num(self.interpolation_error, nan=0.0) + _ROUNDING
        return bool((power >= (1 - swing) * np.maximum.accumulate(power)).all())

    @cached_property
    def samples(self) -> Floats:
        """Speeds along the curve, sixteen in each interval [m/s]."""
        places = np.arange(self.speeds.size)
        fine = np.linspace(0, places[-1], 16 * int(places[-1]) + 1)
        samples: Floats = np.exp(np.interp(fine, places, np.log(self.speeds)))
        samples[::16] = self.speeds
        return samples

    @cached_property
    def largest(self) -> float:
        """Bound of the resistance along the curve [N]."""
        # Between two samples the spline is hardly above them.
        return 1.01 * float((self.power_at_law(self.samples) / self.samples).max())

    @cached_property
    def interpolation_error(self) -> float:
        """Estimated relative error of the spline: from every second point, at those between."""
        if self.speeds.size < 2 * FEWEST - 1:
            return np.nan
        log_speeds, logs = np.log(self.speeds), np.log(self.resistance)
        kept = np.unique(np.r_[0 : logs.size : 2, logs.size - 1])
        coarse = scipy.interpolate.CubicSpline(log_speeds[kept], logs[kept])
        return float(np.abs(np.expm1(coarse(log_speeds) - logs)).max()) / _GAIN

    def relative_error(self, temperature: float, speed: float) -> float:
        """Relative error of the power, of the curve and of its interpolation."""
        scaled = speed * self.shift.factor(temperature)
        own = np.interp(np.log(scaled), np.log(self.speeds), self.errors / self.resistance)
        return float(own) + self.interpolation_error

    def temperature_where(self, factor: float, low: float, high: float) -> float:
        """Temperature between two [K] at which a_T is a factor; the nearer one without such."""

        def beyond(temperature: float) -> float:
            return float(np.log(self.shift.factor(temperature) / factor))

        if beyond(low) <= 0:
            return low
        return (
            high
            if beyond(high) >= 0
            else float(scipy.optimize.brentq(beyond, low, high, xtol=1e-10))
        )
