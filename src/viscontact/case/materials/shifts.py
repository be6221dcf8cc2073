"""Sections of time-temperature shifts."""

from __future__ import annotations

import re
from abc import abstractmethod
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from viscontact import tables
from viscontact.bodies import laws
from viscontact.case.data_file import DataFile, FileSection
from viscontact.case.quantities import MolarEnergy, Temperature, TemperatureDifference
from viscontact.case.section_choice import ChosenBy
from viscontact.units.temperatures import in_celsius

_ROUNDED = 1e-4  # deviation of a written factor from 1 at the temperature of the law


class Rule(FileSection):
    """Rule for the shift factor as a function of temperature."""

    @property
    def is_referred(self) -> bool:
        """True if a run without a temperature is computed at that of the law."""
        return False

    @abstractmethod
    def build(self) -> laws.Shift:
        """Return the rule."""


class Wlf(Rule):
    """The rule of Williams, Landel and Ferry: log10 a_T = -c1 (T - T_r)/(c2 + T - T_r)."""

    kind: Literal["wlf"]
    reference_temperature: Temperature = Field(description="T_r, at which the law is given")
    c1: Annotated[float, Field(gt=0)] = Field(description="C_1 of the decimal logarithm")
    c2: TemperatureDifference = Field(description="C_2")

    def build(self) -> laws.Shift:
        """Return the rule."""
        return laws.WLF(self.reference_temperature, self.c1, self.c2)


class Arrhenius(Rule):
    """The rule of Arrhenius: ln a_T = (E_a/R)(1/T - 1/T_r)."""

    kind: Literal["arrhenius"]
    reference_temperature: Temperature = Field(description="T_r, at which the law is given")
    activation_energy: MolarEnergy = Field(description="E_a, independent of temperature")

    def build(self) -> laws.Shift:
        """Return the rule."""
        return laws.Arrhenius(self.reference_temperature, self.activation_energy)


class Factors(Rule):
    """Shift factors as measured, in a CSV file or here: 1 at the temperature of the law."""

    kind: Literal["factors"]
    file: DataFile | None = Field(
        default=None,
        description="table with a header such as: T [degC], log_aT",
        examples=["factors.csv"],
    )
    temperatures: list[Temperature] | None = Field(
        default=None, description="those of the factors, increasing, in place of a file"
    )
    factors: list[Annotated[float, Field(gt=0)]] | None = Field(
        default=None, description="a_T at each of the temperatures"
    )
    vertical: list[Annotated[float, Field(gt=0)]] | None = Field(
        default=None, description="b_T at each of the temperatures, by which moduli are multiplied"
    )
    reference_temperature: Temperature | None = Field(
        default=None,
        description="temperature of the law, at which a run without a temperature is computed",
    )

    @property
    def is_referred(self) -> bool:
        """True if a run without a temperature is computed at that of the law."""
        return self.reference_temperature is not None

    def build(self) -> laws.Shift:
        """Return the rule, linear in ln a_T between the temperatures."""
        if self.file is not None:
            for key in ("temperatures", "factors", "vertical"):
                if getattr(self, key) is not None:
                    raise ValueError(f"shift.{key}: is given in the file; leave one of them out")
            shift = self._from_file()
        elif self.temperatures is None or self.factors is None:
            raise ValueError(
                "shift: give a file, or temperatures and factors, e.g. "
                "'{kind: factors, temperatures: [20 degC, 40 degC], factors: [1, 0.01]}'"
            )
        else:
            shift = self._of_lists(self.temperatures, self.factors)
        self._require_reference(shift)
        return shift

    def _of_lists(self, temperatures: list[float], factors: list[float]) -> laws.Shift:
        try:
            return laws.TabulatedShift(temperatures, factors, self.vertical)
        except ValueError as error:
            why = str(error).removeprefix("TabulatedShift: ")
            # Entries of a file are counted from 1.
            entry = re.match(r"(\w+)\[(\d+)\] ", why)
            if entry is None:
                raise ValueError(f"shift: {why}") from error
            place = f"shift.{entry[1]}[{int(entry[2]) + 1}]"
            raise ValueError(f"{place}: {why[entry.end() :]}") from error

    def _require_reference(self, shift: laws.Shift) -> None:
        if self.reference_temperature is None:
            return
        factor = shift.factor(self.reference_temperature)
        if abs(factor - 1.0) > _ROUNDED:
            raise ValueError(
                "shift.reference_temperature: must be the temperature of the law, where the factor "
                f"is 1, got {factor:.4g} at {in_celsius(self.reference_temperature):.4g} °C"
            )

    def _from_file(self) -> laws.Shift:
        assert self.file is not None  # given
        try:
            table = tables.read_table(self.file, wanted=("shift_factor",))
            order = np.argsort(table["temperature"], kind="stable")
            temperatures, factors = table["temperature"][order], table["shift_factor"][order]
            return laws.TabulatedShift(temperatures.tolist(), factors.tolist())
        except ValueError as error:
            raise ValueError(f"shift.file: {error}") from error


AnyShift = Annotated[Wlf | Arrhenius | Factors, ChosenBy("kind")]
