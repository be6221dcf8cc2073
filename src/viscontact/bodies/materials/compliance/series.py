"""Contact compliance that is a finite sum of exponentials."""

from __future__ import annotations

from dataclasses import field
from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws.interconversion.series import (
    RelaxationTerms,
    SeriesTerms,
    creep_function,
    creep_mean,
    merged,
    relaxation_from_creep,
    relaxation_function,
)
from viscontact.bodies.laws.parameter_checks import check_series
from viscontact.bodies.materials import compliance
from viscontact.bodies.materials.compliance.base import ContactCompliance
from viscontact.units.numbers import check_fields, non_negative, store


@dataclass(frozen=True, eq=False)
class SeriesCompliance(ContactCompliance):
    """J(t) = instant + sum amplitudes (1 - exp(-t/times)) + fluidity t.

    Parameters
    ----------
    instant : float
        J(0) >= 0 [1/Pa].
    amplitudes : array_like
        Delayed compliances >= 0 [1/Pa]. Zeros are dropped.
    times : array_like
        Retardation times > 0 [s], one for each amplitude. Equal times are merged; what is
        stored ascends.
    fluidity : float, optional
        Rate of steady flow >= 0 [1/(Pa s)].

    Raises
    ------
    ValueError
        If a compliance is negative, a time not positive, a value not finite, or lengths differ.

    Examples
    --------
    >>> one = SeriesCompliance(1e-9, [1e-9, 0.0, 1e-9], [2.0, 3.0, 2.0])
    >>> both = one + one
    >>> both.instant, both.amplitudes.tolist(), both.times.tolist()
    (2e-09, [4e-09], [2.0])
    >>> both(0.0), round(both.relaxation(0.0))
    (2e-09, 500000000)
    """

    instant: float = field(metadata={"unit": "1/Pa"})
    amplitudes: Floats = field(metadata={"unit": "1/Pa"})
    times: Floats = field(metadata={"unit": "s"})
    fluidity: float = field(default=0.0, metadata={"unit": "1/(Pa s)"})

    def __post_init__(self) -> None:
        check_fields(self, "instant", "fluidity", check=non_negative)
        check_series(self, "amplitudes")
        amplitudes, times = merged(self.amplitudes, self.times)
        amplitudes.flags.writeable = times.flags.writeable = False
        store(self, amplitudes=amplitudes, times=times)

    @property
    def term_count(self) -> int:
        """Number of exponentials, plus one for steady flow."""
        return len(self.times) + (self.fluidity > 0)

    @property
    def settled_after(self) -> float:
        """Five of the longest times [s]; of a fluid, including instant/fluidity."""
        times = self.times.tolist()
        if self.fluidity > 0 and self.instant > 0:
            times.append(self.instant / self.fluidity)
        return 5 * max(times, default=0.0)

    @property
    def is_elastic(self) -> bool:
        """True without creep and flow."""
        return not (self.amplitudes.size or self.fluidity)

    def scaled(self, factor: float) -> SeriesCompliance:
        """Return the compliance times a factor."""
        amplitudes = factor * self.amplitudes
        return SeriesCompliance(
            factor * self.instant, amplitudes, self.times, factor * self.fluidity
        )

    def __add__(self, other: ContactCompliance) -> ContactCompliance:
        """Return the compliance of two bodies pressed on each other."""
        if not isinstance(other, SeriesCompliance):
            return compliance.SummedCompliance((self,)) + other
        return SeriesCompliance(
            self.instant + other.instant,
            np.concatenate([self.amplitudes, other.amplitudes]),
            np.concatenate([self.times, other.times]),
            self.fluidity + other.fluidity,
        )

    def _creep(self, t: Floats) -> Floats:
        return creep_function(self._terms, t)

    def _relaxation(self, t: Floats) -> Floats:
        return relaxation_function(self._inverse, t)

    def _mean_creep(self, start: Floats, end: Floats) -> Floats:
        return creep_mean(self._terms, start, end)

    @property
    def _terms(self) -> SeriesTerms:
        return SeriesTerms(self.instant, self.amplitudes, self.times, self.fluidity)

    @cached_property
    def _inverse(self) -> RelaxationTerms:
        return relaxation_from_creep(*self._terms)
