"""Sections of laws from files: measured tables, and cards of finite-element programs."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any, Literal

from pydantic import Field

from viscontact import tables
from viscontact.bodies import laws, series_fits
from viscontact.bodies.laws import Law
from viscontact.bodies.materials import cards
from viscontact.bodies.materials.material import Material
from viscontact.case.data_file import DataFile, at_key
from viscontact.case.materials.base import Medium
from viscontact.case.materials.measured_record import measured_record
from viscontact.case.materials.oscillation import fit_note, fit_oscillation, fit_warning
from viscontact.case.quantities import Modulus
from viscontact.units.parsing import parse_scale
from viscontact.units.temperatures import in_celsius

# Quantities whose headings state the kind of test.
_STATING = ("creep_compliance", "relaxation_modulus", "storage_modulus", "loss_modulus")
# Tolerance between the temperature of a table and the one that its shift refers to [K].
_SAME_TEMPERATURE = 1.0
_AT_ROW = re.compile(r"\w+(?:\.from_\w+)?\.(?P<column>\w+), row (?P<row>\d+): (?P<why>.*)", re.S)


class FromFile(Medium):
    """Law from a file."""

    file: DataFile

    @property
    def files(self) -> Mapping[tuple[str, ...], Path]:
        """Files of the law and of its shift, by their keys."""
        return {("file",): Path(self.file), **super().files}


class TableLaw(FromFile):
    """A measured table: compliance or modulus at its own times, or a fit to an oscillation."""

    law: Literal["table"]
    file: DataFile = Field(
        description="table with a header such as: time [s], creep_compliance [1/MPa]; a series is "
        "fitted to: f [Hz], E' [MPa], E'' [MPa]",
        examples=["pmma.csv"],
    )
    quantity: Literal["creep_compliance", "relaxation_modulus"] | None = Field(
        default=None, description="quantity of the values; needed where there are both"
    )
    data: Literal["deviatoric", "shear", "uniaxial"] | None = Field(
        default=None,
        description="kind of test, where the headings do not state it: compliances are deviatoric "
        "(Phi = 1/(2G)), shear (1/G) or uniaxial (1/E); moduli shear (G) or uniaxial (E)",
    )
    before: Literal["first", "slope"] = Field(
        default="first", description="before the first row: its value, or its slope in log time"
    )
    beyond: Literal["slope", "last"] = Field(
        default="slope", description="beyond the last row: its slope in log time, or its value"
    )
    set: float | None = Field(
        default=None, description="number of the set, where there are several"
    )
    stress: Modulus | None = Field(
        default=None,
        description="stress of a creep test given as strain; of several tests, the one to use",
        examples=["5 MPa"],
    )
    columns: dict[str, str | None] | str = Field(
        default={},
        description="quantities of columns with unclear headings, e.g. 'E: relaxation_modulus'; or "
        "names of all columns, where the table has none, as 'time [s], G [MPa]'",
        examples=[{"E_1": "relaxation_modulus", "remark": None}],
    )

    def build_law(self) -> Law:
        """Return the law, from a deviatoric, shear or uniaxial table."""
        if self.fit is not None:
            return self.fit.law
        table, quantity = self.table, self._quantity
        if quantity == "relaxation_modulus" and self._data == "deviatoric":
            raise ValueError("data: moduli are shear or uniaxial; deviatoric is a compliance")
        try:
            times, values = table["time"].tolist(), table[quantity].tolist()
        except ValueError as error:
            raise ValueError(f"file: {error}") from error
        try:
            return self._law(times, values)
        except ValueError as error:
            raise ValueError(f"file: {self._error_in_file(table, error)}") from error

    @cached_property
    def table(self) -> tables.Table:
        """The table, or its chosen set, checked against the other keys."""
        try:
            table = self._chosen_columns(self._whole_table)
            table = table.ascending("time") if "time" in table else table
        except ValueError as error:
            raise ValueError(at_key(self._other_kind() or str(error))) from error
        self._require_test(table)
        return table

    def _other_kind(self) -> str | None:
        """What a file that is no table is, if that is known."""
        try:
            text = tables.read_text(Path(self.file))
        except ValueError:
            return None
        name = Path(self.file).name
        unread = cards.unread_program(text, name)
        if unread is None and cards.is_card(text):
            return f"{name}: is a material card; give law: card, with modulus_unit and time_unit"
        return unread

    @property
    def _whole_table(self) -> tables.Table:
        wanted = (*_STATING, "modulus", "creep_modulus", "strain", "stress", "complex_modulus")
        return tables.read_table(self.file, self.columns, stress=self.stress, wanted=wanted)

    @property
    def _quantity(self) -> str:
        """The given quantity, or the only one over time in the table."""
        if self.quantity is not None:
            return self.quantity
        table = self.table
        found = [name for name in ("creep_compliance", "relaxation_modulus") if name in table]
        if len(found) == 1:
            return found[0]
        if found:
            raise ValueError(f"quantity: {table.source.name} has {' and '.join(found)}; name one")
        raise ValueError(
            f"file: {table.source.name}: needs a creep compliance or a relaxation modulus over "
            f"time, or storage and loss modulus over frequency; {table.contents}"
        )

    @property
    def _data(self) -> str:
        """The kind of test, as given or as the headings state it."""
        data = self.data or self.table.data
        if data is None:
            raise ValueError(
                f"data: the headings of {self.table.source.name} do not state the kind of test; "
                "give shear (G, 1/G), uniaxial (E, 1/E) or deviatoric (Phi)"
            )
        return data

    @cached_property
    def fit(self) -> series_fits.Fit | None:
        """Series fitted to an oscillation; None for a table over time."""
        if not series_fits.is_oscillation(self.table):
            return None
        if self.quantity is not None and self.quantity in self.table:
            return None
        for key in ("quantity", "before", "beyond"):
            if getattr(self, key) != type(self).model_fields[key].default:
                raise ValueError(
                    f"{key}: {self.table.source.name} is an oscillation, to which a series is "
                    "fitted; leave it out"
                )
        if self._data == "deviatoric":
            raise ValueError("data: moduli are shear or uniaxial; deviatoric is a compliance")
        return fit_oscillation(self.table, self._data, self.poisson_ratio, self.bulk_modulus)

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes on the sheet that is read of several, and on the fit to an oscillation."""
        source = self.table.source
        chosen = () if source == Path(self.file) else (f"{source.name}: this sheet is read",)
        return chosen if self.fit is None else (*chosen, fit_note(self.table, self.fit))

    @property
    def measured(self) -> dict[str, Any]:
        """The table in the quantities that were measured."""
        return measured_record(self.table, self._data)

    @property
    def misfit(self) -> str | None:
        """Warning of a fit that misses the table."""
        return None if self.fit is None else fit_warning(self.table, self.fit)

    @property
    def fitted_until(self) -> float | None:
        """Time of the lowest frequency of an oscillation [s]."""
        return None if self.fit is None else float(1.0 / self.fit.points.min())

    def _law(self, times: list[float], values: list[float]) -> Law:
        options: dict[str, Any] = {"before": self.before, "beyond": self.beyond}
        tables: dict[str, Any] = {
            "creep_compliance": laws.TabulatedCreep,
            "relaxation_modulus": laws.TabulatedRelaxation,
        }
        table = tables[self._quantity]
        if self._data == "uniaxial":
            law = table.from_uniaxial(times, values, **options, **self._in_volume)
        elif self._data == "shear":
            law = table.from_shear(times, values, **options)
        else:
            law = table(times, values, **options)
        assert isinstance(law, Law)
        return law

    def _chosen_columns(self, table: tables.Table) -> tables.Table:
        sets = table.sets()
        if self.set is not None:
            found = [each for each in sets if each.set_number == self.set]
            if not found:
                raise ValueError(f"{table.source.name} has no set {self.set:g}; {_set_list(sets)}")
            return found[0]
        if len(sets) > 1:
            name = table.source.name
            raise ValueError(
                f"{name} has {len(sets)} sets; {_which(sets)}; or shift all to one temperature by "
                f"`viscontact fit {name} --yaml law.yaml`, and give file: law.yaml in place of "
                "law: table"
            )
        return table

    def _require_test(self, table: tables.Table) -> None:
        if table.data is not None and self.data not in (None, table.data):
            heading = next((table.headings[name] for name in _STATING if name in table), "")
            raise ValueError(
                f"data: {self.data} contradicts {table.source.name}, where the column {heading!r} "
                f"is {table.data}"
            )
        measured, shift = table.temperature, self.shift
        reference = getattr(shift, "reference_temperature", None)
        if measured is None or reference is None:
            return
        if abs(measured - reference) > _SAME_TEMPERATURE:
            raise ValueError(
                f"shift: its reference_temperature is {in_celsius(reference):.4g} °C, and "
                f"{table.source.name} was measured at {in_celsius(measured):.4g} °C; give the "
                "constants for the temperature of the table"
            )

    def _error_in_file(self, table: tables.Table, error: ValueError) -> str:
        """Return an error of a law at its place in the file, not at its argument."""
        match = _AT_ROW.match(str(error))
        if match is None or int(match["row"]) >= len(table):
            return table.located(error)
        heading = table.headings["time" if match["column"] == "times" else self._quantity]
        why = table.located(ValueError(match["why"]))
        why = why.replace(
            "smooth out the noise", "smooth out the noise, or fit a series to the table"
        )
        return f"{table.source.name}:{table.lines[int(match['row'])]}: column {heading!r}: {why}"


def _which(sets: tuple[tables.Table, ...]) -> str:
    """What tells a case which of several sets it has."""
    if all(each.set_number is None for each in sets):
        return (
            "give their rows a column Set with numbers, as 1 and 2, and say here which is meant, "
            "as set: 1"
        )
    return f"say which with set: {_set_list(sets)}"


def _set_list(sets: tuple[tables.Table, ...]) -> str:
    return ", ".join(
        f"{each.set_number:g}"
        + ("" if each.temperature is None else f" ({in_celsius(each.temperature):.3g} °C)")
        for each in sets
        if each.set_number is not None
    )


class CardLaw(FromFile):
    """A material of Abaqus, Ansys or LS-DYNA: its law, its volume behaviour and its shift."""

    law: Literal["card"]
    file: DataFile = Field(
        description="Abaqus (*ELASTIC, *VISCOELASTIC, *TRS), Ansys (MP, TB,PRONY, TB,SHIFT) or "
        "LS-DYNA (*MAT_001, _006, _076)",
        examples=["polymer.inp"],
    )
    modulus_unit: str = Field(description="of the card's moduli", examples=["MPa"])
    time_unit: str = Field(description="of the card's times", examples=["s"])
    temperature_unit: str | None = Field(
        default=None, description="of the card's temperatures, if it has a shift", examples=["degC"]
    )
    name: str | None = Field(
        default=None, description="name or number of the material, where there are several"
    )

    def build_law(self) -> Law:
        """Return the card's law."""
        return self.built.law

    @cached_property
    def card(self) -> cards.Card:
        """Return the card of the file."""
        self._require_units()
        try:
            return cards.read_card(
                self.file,
                modulus_unit=self.modulus_unit,
                time_unit=self.time_unit,
                temperature_unit=self.temperature_unit,
                name=self.name,
            )
        except ValueError as error:
            raise ValueError(f"file: {error}") from error

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes on contents of the card that are not used."""
        return self.card.notes

    def build(self) -> Material:
        """Return the card's material, at the run's temperature."""
        for key in ("poisson_ratio", "bulk_modulus"):
            if getattr(self, key) is not None:
                raise ValueError(f"{key}: is given in the card; leave it out")
        card = self.card
        if card.shift is not None and self.shift is not None:
            raise ValueError("shift: is given in the card; leave it out")
        return self._at_temperature(
            replace(
                card.material,
                notes=card.notes,
                warning=self.warning or card.material.warning,
                ageing=self.ageing.build() if self.ageing else None,
            ),
            card.shift or (self.shift.build() if self.shift else None),
        )

    def _require_units(self) -> None:
        units = {"modulus_unit": "pressure", "time_unit": "time", "temperature_unit": "temperature"}
        for key, dimension in units.items():
            given = getattr(self, key)
            try:
                _ = given is None or parse_scale(given, dimension)
            except ValueError as error:
                raise ValueError(f"{key}: {error}") from error
