"""Sections of time-temperature shifts."""

from __future__ import annotations

from abc import abstractmethod
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from viscontact.bodies import laws
from viscontact.case.data_file import DataFile, FileSection
from viscontact.case.quantities import MolarEnergy, Temperature, TemperatureDifference
from viscontact.case.section_choice import ChosenBy
from viscontact.tables import read_table


class Rule(FileSection):
    """Rule for the shift factor as a function of temperature."""

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
    """Shift factors as measured, in a CSV file: 1 at the temperature the law is given at."""

    kind: Literal["factors"]
    file: DataFile = Field(
        description="table with a header such as: T [degC], log_aT", examples=["factors.csv"]
    )

    def build(self) -> laws.Shift:
        """Return the rule, linear in ln a_T between the rows."""
        try:
            table = read_table(self.file, wanted=("shift_factor",))
            order = np.argsort(table["temperature"], kind="stable")
            temperatures, factors = table["temperature"][order], table["shift_factor"][order]
            return laws.TabulatedShift(temperatures.tolist(), factors.tolist())
        except ValueError as error:
            raise ValueError(f"shift.file: {error}") from error


AnyShift = Annotated[Wlf | Arrhenius | Factors, ChosenBy("kind")]
