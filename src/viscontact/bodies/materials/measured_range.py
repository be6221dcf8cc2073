"""Range of the tests that a law rests on: strain, stress, times, temperatures."""

from __future__ import annotations

from dataclasses import field, replace

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.units.display import Displayable
from viscontact.units.numbers import check_fields, non_negative, positive, store


@dataclass(frozen=True)
class MeasuredRange(Displayable):
    """Strains, stresses, times and temperatures of the tests that a law rests on.

    A run beyond them issues a warning. What the source of the law does not state is left out.

    Parameters
    ----------
    strain : float, optional
        Largest strain of a uniaxial test [-].
    shear_strain : float, optional
        Largest shear strain (angle) of a test in shear [-].
    stress : float, optional
        Largest stress of a uniaxial test [Pa].
    first : float
        First time after a change of load for which the law was measured [s]; 0 if also the response
        at once was. The last one is ``Material.measured_until``.
    temperatures : pair of float, optional
        Lowest and highest temperature of the tests [K].
    used_at : float, optional
        Temperature at which the law is used, if it was shifted there [K]; set by `Material.at`.

    Raises
    ------
    ValueError
        If a number is not positive, or the temperatures are no pair from low to high.

    Examples
    --------
    >>> MeasuredRange(strain=0.005, temperatures=(293.15, 333.15)).temperatures
    (293.15, 333.15)
    """

    strain: float | None = field(default=None, metadata={"unit": "1", "recorded": "if given"})
    shear_strain: float | None = field(default=None, metadata={"unit": "1", "recorded": "if given"})
    stress: float | None = field(default=None, metadata={"unit": "Pa", "recorded": "if given"})
    first: float = field(default=0.0, metadata={"unit": "s", "recorded": "if given"})
    temperatures: tuple[float, float] | None = field(
        default=None, metadata={"unit": "K", "recorded": "if given"}
    )
    used_at: float | None = field(default=None, metadata={"unit": "K", "recorded": "if given"})

    def __post_init__(self) -> None:
        check_fields(self, "strain", "shear_strain", "stress", "used_at")
        store(self, first=non_negative("MeasuredRange: first", self.first, "s"))
        if self.temperatures is None:
            return
        pair = tuple(
            positive(f"MeasuredRange: temperatures[{i}]", each, "K")
            for i, each in enumerate(self.temperatures)
        )
        if len(pair) != 2 or pair[0] > pair[1]:
            raise ValueError(
                "MeasuredRange: temperatures must be the lowest and the highest of the tests, got "
                f"{self.temperatures!r}"
            )
        store(self, temperatures=pair)

    def of_scaled(self, factor: float) -> MeasuredRange:
        """Return the range of a law whose moduli are multiplied by a factor: the narrower one."""
        # A softer law has the strains of the tests at lower stresses. Of a stiffer one nothing was
        # tested at higher stresses.
        stress = None if self.stress is None else min(1.0, factor) * self.stress
        return replace(self, stress=stress)

    def at(self, temperature: float, factor: float) -> MeasuredRange:
        """Return the range of a law that is shifted to a temperature [K], by a factor a_T."""
        return replace(self, first=factor * self.first, used_at=temperature)
