"""Contact point and baseline that were fitted together with a law."""

from __future__ import annotations

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.units.formatting import format_quantity

#: Terms of a baseline, with their units.
BASELINE_UNITS = {"offset": "m", "slope": "", "drift": "m/s", "drag": "s"}


@dataclass(frozen=True, repr=False)
class FittedContact:
    """Contact point and baseline of a force curve, fitted together with a law.

    Attributes
    ----------
    position : float
        Position of the base at first contact [m].
    position_interval : (float, float)
        Its confidence interval [m].
    baseline : dict of str to float
        Terms of the deflection without contact: ``"offset"`` at position 0 and time 0 [m],
        ``"slope"`` over the position [-], ``"drift"`` over time [m/s] and ``"drag"`` over the
        velocity of the base [s], as far as the curve tells them apart.
    baseline_intervals : dict of str to (float, float)
        Confidence interval of each.

    Examples
    --------
    >>> FittedContact(1e-6, (9.9e-7, 1.01e-6), {"offset": 0.0}, {"offset": (-1e-9, 1e-9)})
    contact at 1 µm (990 nm to 1.01 µm); baseline: offset 0 m (-1 nm to 1 nm)
    """

    position: float
    position_interval: tuple[float, float]
    baseline: dict[str, float]
    baseline_intervals: dict[str, tuple[float, float]]

    def __repr__(self) -> str:
        low, high = (format_quantity(end, "m", 5) for end in self.position_interval)
        at = format_quantity(self.position, "m", 5)
        terms = ", ".join(
            f"{name} {_quantity(name, value)} ({_quantity(name, low)} to {_quantity(name, high)})"
            for name, value in self.baseline.items()
            for low, high in [self.baseline_intervals[name]]
        )
        return f"contact at {at} ({low} to {high}); baseline: {terms}"


def _quantity(name: str, value: float) -> str:
    unit = BASELINE_UNITS[name]
    return format_quantity(value, unit, 3) if unit == "m" else f"{value:.3g} {unit}".strip()
