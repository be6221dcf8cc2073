"""Balances of a power and a linear cooling over temperature: all of them, and the runaway."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.heating.power_curve import PowerCurve

#: Least temperature rise that counts [K], samples of the rise, and the highest speed at which the
#: runaway is sought, over the largest speed of the curve.
_LEAST, _SAMPLES, _FURTHER = 1e-4, 400, 10.0


@dataclass(frozen=True)
class Balance:
    """Temperature at which as much heat arises as flows off [K]."""

    temperature: float
    is_stable: bool  # dP/dT < hA: a small disturbance dies away


@dataclass(frozen=True)
class Sink:
    """Cooling of a body: power = conductance x (temperature - idle)."""

    conductance: float  # [W/K]
    idle: float  # temperature without a source [K]

    def power(self, temperature: Floats) -> Floats:
        """Power that flows off at temperatures [K] [W]."""
        return self.conductance * (temperature - self.idle)

    def warmest(self, power: float) -> float:
        """Temperature at which a power flows off [K]."""
        return self.idle + power / self.conductance


@dataclass(frozen=True)
class Reach:
    """Temperatures at which a curve gives the power at a speed, as far as balances may be [K]."""

    low: float
    high: float
    top: float  # no balance is above
    is_shift_at_end: bool  # the shift holds up to `high` only

    @property
    def is_empty(self) -> bool:
        """True if the curve gives no power at any temperature of a balance."""
        return not self.high > self.low


def all_balances(excess: Callable[[Floats], Floats], samples: Floats) -> list[Balance]:
    """Zeros of power minus cooling over temperature, between samples of it [K], the coldest first.

    Zeros are bracketed by a change of the sign; a pair between samples by the extremum between
    them.
    """

    def one(temperature: float) -> float:
        return float(excess(np.array([temperature]))[0])

    values = excess(samples)
    places = [float(samples[0])]
    for n in range(1, samples.size - 1):
        before, here, after = np.sign(values[n]) * values[n - 1 : n + 2]
        if before > 0 and after > 0 and here <= min(before, after):
            sign = float(np.sign(values[n]))
            found = scipy.optimize.minimize_scalar(
                lambda t, sign=sign: sign * one(t),
                bounds=(samples[n - 1], samples[n + 1]),
                method="bounded",
                options={"xatol": 1e-12 * samples[n]},
            )
            places += [float(found.x)] if found.fun < 0 else []
        places.append(float(samples[n]))
    places = sorted([*places, float(samples[-1])])
    signs = np.sign(excess(np.array(places))).tolist()
    balances = []
    for n in range(len(places) - 1):
        if signs[n] * signs[n + 1] < 0:
            zero = scipy.optimize.brentq(one, places[n], places[n + 1], xtol=1e-10)
            balances.append(Balance(float(zero), bool(signs[n] > 0)))
        elif signs[n] == 0:
            balances.append(Balance(places[n], bool(n == 0 or signs[n - 1] > 0)))
    return balances


def reach_of(curve: PowerCurve, sink: Sink, speed: float) -> Reach:
    """Temperatures at which a curve gives the power at a speed; ValueError where no shift holds."""
    curve.shift.factor(sink.idle)  # refuses a temperature that it does not hold for
    top = sink.warmest(speed * curve.largest)
    held = _shift_end(curve, sink.idle, top)
    slow, fast = curve.speeds[[0, -1]]
    low = curve.temperature_where(float(fast) / speed, sink.idle, held)
    high = curve.temperature_where(float(slow) / speed, sink.idle, held)
    is_beyond = speed * curve.shift.factor(low) > fast * (1 + 1e-9)  # all too cold
    return Reach(low, low if is_beyond else high, top, held < top and high == held)


def _shift_end(curve: PowerCurve, low: float, high: float) -> float:
    """Highest temperature up to `high` at which the shift holds [K]."""

    def holds(temperature: float) -> bool:
        try:
            curve.shift.factor(temperature)
        except ValueError:
            return False
        return True

    if holds(high):
        return high
    inside, outside = low, high
    while outside - inside > 1e-9 * inside:
        middle = (inside + outside) / 2
        inside, outside = (middle, outside) if holds(middle) else (inside, middle)
    return inside


def samples_within(curve: PowerCurve, sink: Sink, speed: float, reach: Reach) -> Floats:
    """Temperatures between which the balances of a speed are looked for [K]."""
    rises = np.geomspace(_LEAST, max(reach.high - sink.idle, 2 * _LEAST), _SAMPLES)
    even = np.linspace(reach.low, reach.high, _SAMPLES)
    # Where the curve has its samples: a_T falls with the temperature.
    falls = -np.log(curve.shift.factor(even))
    along = np.interp(np.log(speed / curve.samples), falls, even)
    inside = np.unique(np.r_[sink.idle + rises, along, reach.low, reach.high])
    return inside[(inside >= reach.low) & (inside <= reach.high)]


def balances_at(curve: PowerCurve, sink: Sink, speed: float, reach: Reach) -> list[Balance]:
    """All balances at a speed [m/s] within the reach of a curve, the coldest first."""
    if reach.is_empty:
        return []
    samples = samples_within(curve, sink, speed, reach)
    return all_balances(lambda t: curve.power(t, speed) - sink.power(t), samples)


def balance_speed(curve: PowerCurve, sink: Sink, temperature: Floats) -> Floats:
    """Speed at which temperatures [K] are a balance [m/s], if the power grows with speed.

    P = V R(V a_T) = G (T - T_idle), so that V a_T is where the power of the law is a_T times the
    cooling. NaN beyond the curve.
    """
    factor = curve.shift.factor(temperature)
    wanted = factor * sink.power(temperature)
    low, high = (np.full(temperature.shape, np.log(end)) for end in curve.speeds[[0, -1]])
    is_within = (wanted >= curve.power_at_law(np.exp(low))) & (
        wanted <= curve.power_at_law(np.exp(high))
    )
    for _ in range(60):
        middle = (low + high) / 2
        is_less = curve.power_at_law(np.exp(middle)) < wanted
        low, high = np.where(is_less, middle, low), np.where(is_less, high, middle)
    return np.where(is_within, np.exp((low + high) / 2) / factor, np.nan)


def balance_line(
    curve: PowerCurve, sink: Sink, fastest: float, count: int = _SAMPLES
) -> tuple[Floats, Floats]:
    """Temperatures [K], and the speeds at which they are balances [m/s]; NaN beyond the curve."""
    top = reach_of(curve, sink, _FURTHER * fastest)
    end = _shift_end(curve, sink.idle, top.top)
    end = max(end if top.is_empty else top.high, sink.idle + 2 * _LEAST)
    temperatures = np.unique(np.r_[
        sink.idle + np.geomspace(_LEAST, end - sink.idle, count),
        np.linspace(sink.idle + _LEAST, end, count),
    ])  # fmt: skip
    if not curve.grows:
        return temperatures, np.full(temperatures.shape, np.nan)
    return temperatures, balance_speed(curve, sink, temperatures)


def runaway(
    curve: PowerCurve, sink: Sink, line: tuple[Floats, Floats]
) -> tuple[float, float] | None:
    """Speed [m/s] and temperature [K] at which the coldest balance ends: power touches cooling."""
    temperatures, speeds = line
    inner = np.flatnonzero((speeds[1:-1] > speeds[:-2]) & (speeds[1:-1] >= speeds[2:])) + 1
    if not inner.size:
        return None
    found = scipy.optimize.minimize_scalar(
        lambda t: -float(balance_speed(curve, sink, np.array([t]))[0]),
        bounds=(temperatures[inner[0] - 1], temperatures[inner[0] + 1]),
        method="bounded",
        options={"xatol": 1e-9},
    )
    return -float(found.fun), float(found.x)
