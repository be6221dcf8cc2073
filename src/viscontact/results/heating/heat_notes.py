"""Notes on a heat balance: what the curve does not reach, and what is left out."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.results.heating.balances import Reach, Sink
from viscontact.results.heating.cover import Cover
from viscontact.results.heating.power_curve import PowerCurve
from viscontact.results.heating.rolling_body import RollingBody
from viscontact.units.formatting import format_quantity
from viscontact.units.temperatures import in_celsius

#: Changes that are noted: of the power by interpolation, of moduli, of times across the cover.
_INTERPOLATION, _VERTICAL, _ACROSS = 0.01, 0.02, 2.0


def celsius(kelvin: float, digits: int = 4) -> str:
    """Format an absolute temperature in °C."""
    return f"{in_celsius(kelvin):.{digits}g} °C"


def reach_notes(
    curve: PowerCurve, sink: Sink, speeds: Floats, reaches: Sequence[Reach]
) -> Iterator[str]:
    """Speeds at which a balance may lie where the curve gives no power."""
    colder = [v for v, r in zip(speeds, reaches, strict=True) if r.low > sink.idle or r.is_empty]
    if colder:
        yield (
            f"at {_listed(colder)} the curve gives no power of the cold body: colder balances are "
            f"not known; compute the curve {_missing(curve, sink, colder)}, which is the speed "
            "times the shift factor at rest"
        )
    hotter = [
        (v, r)
        for v, r in zip(speeds, reaches, strict=True)
        if not r.is_empty and r.high < r.top and _is_heated(curve, sink, v, r)
    ]
    for is_shift, why in (
        (False, "the curve gives no power of the hot body: compute it at slower speeds as well"),
        (True, "the shift does not hold for the hot body: use WLF or Arrhenius beyond its table"),
    ):
        found = [(v, r) for v, r in hotter if r.is_shift_at_end is is_shift]
        if found:
            warmest = celsius(max(r.high for _, r in found))
            yield (
                f"at {_listed([v for v, _ in found])} more heat arises than flows off up to "
                f"{warmest}, and beyond {why}; hotter balances are not known"
            )


def _missing(curve: PowerCurve, sink: Sink, speeds: Sequence[float]) -> str:
    """Speeds that a curve lacks for the power at rest: faster ones, or slower ones if it is hot."""
    at_rest = np.array(speeds) * float(curve.shift.factor(sink.idle))
    fastest, slowest = 1.01 * float(at_rest.max()), float(at_rest.min()) / 1.01
    if fastest < curve.speeds[0]:
        return f"down to {format_quantity(slowest, 'm/s', 3)}"
    return f"up to {format_quantity(fastest, 'm/s', 3)}"


def _is_heated(curve: PowerCurve, sink: Sink, speed: float, reach: Reach) -> bool:
    high = np.array([reach.high])
    return bool(curve.power(high, speed)[0] > sink.power(high)[0])


def _listed(speeds: Sequence[float]) -> str:
    if len(speeds) == 1:
        return format_quantity(speeds[0], "m/s", 3)
    ends = (format_quantity(each, "m/s", 3) for each in (min(speeds), max(speeds)))
    return f"{len(speeds)} speeds from {' to '.join(ends)}"


def general_notes(body: RollingBody, curve: PowerCurve, temperatures: Floats) -> Iterator[str]:
    """What a balance leaves out, for the temperatures of all balances [K]."""
    if body.heats_both:
        yield "both bodies creep: they are taken at one temperature, and the area as that of both"
    if np.isnan(curve.interpolation_error):
        yield "with so few speeds the error of the power between them is not known"
    if curve.interpolation_error > _INTERPOLATION:
        yield (
            f"the power between the speeds of the curve is known to "
            f"{100 * curve.interpolation_error:.2g} % only: compute it at more speeds"
        )
    if temperatures.size:
        raised = np.asarray(curve.shift.vertical_factor(temperatures))
        if np.abs(raised - 1).max() > _VERTICAL:
            yield (
                f"the vertical shift is left out: at the balances the moduli are "
                f"{raised.min():.3g} to {raised.max():.3g} times those of the curve"
            )
    if not curve.grows:
        yield (
            "the power at a constant temperature falls with the speed on a part of the curve: the "
            "speed of a runaway is not looked for"
        )


def across_note(cover: Cover, curve: PowerCurve, fluxes: Floats) -> Iterator[str]:
    """How the times of the law differ between surface and hot spot, for heat sources [W/m²]."""
    ratios = []
    for flux in fluxes:
        temperatures = cover.profile(cover.steady(float(flux)))[1]
        ends = np.array([temperatures.min(), temperatures.max()])
        try:
            cold, hot = curve.shift.factor(ends)
        except ValueError:
            cold, hot = np.inf, 1.0
        ratios.append(cold / hot)
    if ratios and max(ratios) > _ACROSS:
        size = f"by a factor of {max(ratios):.2g}" if np.isfinite(max(ratios)) else "without bound"
        yield (
            f"the times of the law change {size} between the coldest and the hottest place of the "
            "cover; the power is that at the mean temperature"
        )
