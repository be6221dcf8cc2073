"""Measured table: columns in SI units, and the sets of rows that belong together."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.tables.names import Data
from viscontact.units.formatting import format_quantity
from viscontact.units.temperatures import in_celsius

# Chambers keep a temperature within some tenths of a kelvin; tests change it by several.
_SAME_TEMPERATURE, _WIDEST_SET = 1.0, 5.0
# Fewest rows of a test under a varying temperature, and rows between two jumps of it.
_LEAST_ROWS, _ROWS_PER_JUMP = 6, 3


@dataclass(frozen=True, eq=False)
class Table:
    r"""A measured table.

    Made by `read_table`.

    Attributes
    ----------
    source : Path
        The file; with the sheet behind ``#`` if a spreadsheet has several tables.
    columns : mapping of str to ndarray, each of shape (rows,)
        By quantity, in the file's order, in SI units: a key of
        `viscontact.tables.names.QUANTITIES`.
    data : str or None
        The kind of test that the headings state: ``"shear"`` (G, J), ``"uniaxial"`` (E, D) or
        ``"deviatoric"`` (Phi); None if they do not.
    headings : mapping of str to str
        Names of the columns in the file, by quantity.
    lines : ndarray of int, shape (rows,)
        Line of the file or sheet of each row, from 1.
    left_out : tuple of str
        Headings of columns that are not known and not read.

    Examples
    --------
    >>> import tempfile
    >>> from viscontact.tables import read_table
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "creep.csv"
    ...     _ = file.write_text("time [min], D [1/GPa]\n1, 0.5\n2, 0.6\n")
    ...     table = read_table(file)
    >>> table.data, table["time"].tolist(), table["creep_compliance"].tolist()
    ('uniaxial', [60.0, 120.0], [5e-10, 6e-10])
    """

    source: Path
    columns: Mapping[str, Floats]
    data: Data | None
    headings: Mapping[str, str]
    lines: NDArray[np.int64]
    left_out: tuple[str, ...] = ()

    def __getitem__(self, quantity: str) -> Floats:
        """Return a column; ValueError naming those that there are, if there is no such."""
        if quantity not in self.columns:
            hint = "; name their quantities with columns=" if self.left_out else ""
            raise ValueError(
                f"{self.source.name}: the column {quantity} is missing; {self.contents}{hint}"
            )
        return self.columns[quantity]

    def __contains__(self, quantity: object) -> bool:
        return quantity in self.columns

    def __len__(self) -> int:
        return int(self.lines.size)

    def __repr__(self) -> str:
        return f"Table({self.source.name}: {len(self)} rows of {', '.join(self.columns)})"

    @property
    def contents(self) -> str:
        """Columns in words, for messages: those read, and the headings that are not known."""
        found = ", ".join(f"{q} ({self.headings[q]!r})" for q in self.columns)
        left = ", ".join(map(repr, self.left_out))
        return f"there are {found}" + (f"; not known: {left}" if left else "")

    @property
    def temperature(self) -> float | None:
        """Mean temperature of the rows [K]; None without such a column.

        ValueError if it spreads over more than 5 K: then these are several sets.
        """
        if "temperature" not in self:
            return None
        values = self["temperature"]
        if np.ptp(values) > _WIDEST_SET:
            raise ValueError(
                f"{self.source.name}: temperatures from {in_celsius(values.min()):.4g} to "
                f"{in_celsius(values.max()):.4g} °C are no single one; take one of its sets"
            )
        return float(np.mean(values))

    @property
    def set_number(self) -> float | None:
        """Number of the set that all rows belong to; None without one."""
        if "set" not in self:
            return None
        numbers = np.unique(self["set"])
        return float(numbers[0]) if numbers.size == 1 else None

    @property
    def has_varying_temperature(self) -> bool:
        """True of creep or relaxation during which the temperature varied, not of several sets.

        Its times, from row to row, go on where the temperature changes, and it seldom jumps.
        """
        over_time = any(each in self for each in ("creep_compliance", "relaxation_modulus"))
        if not over_time or "angular_frequency" in self or "set" in self:
            return False
        if "time" not in self or "temperature" not in self:
            return False
        times, values = self["time"], self["temperature"]
        if len(self) < _LEAST_ROWS or np.ptp(values) <= _SAME_TEMPERATURE:
            return False
        jumps = int(np.count_nonzero(np.abs(np.diff(values)) > _SAME_TEMPERATURE))
        return bool(np.all(np.diff(times) > 0)) and jumps <= len(self) / _ROWS_PER_JUMP

    def sets(self) -> tuple[Table, ...]:
        """Return the sets of rows that belong together.

        Returns
        -------
        tuple of Table
            By the column of set numbers, in the order of their first rows; without one by
            temperature, from cold to warm, a gap of more than 1 K between two; without either
            the table itself. Rows keep their order.

        Raises
        ------
        ValueError
            If temperatures creep on without a gap over more than 5 K, the table is one test
            under a temperature that varies, or would be if its times did not go back in places.
        """
        if "set" in self:
            numbers, first = np.unique(self["set"], return_index=True)
            return tuple(self._rows(self["set"] == n) for n in numbers[np.argsort(first)])
        if "temperature" not in self:
            return (self,)
        if self.has_varying_temperature:
            low, high = (float(in_celsius(each(self["temperature"]))) for each in (np.min, np.max))
            raise ValueError(
                f"{self.source.name}: is one test whose temperature varies from {low:.4g} to "
                f"{high:.4g} °C; find law and shift by `viscontact fit {self.source.name} --yaml "
                "law.yaml`, and give file: law.yaml. If these are tests at several temperatures, "
                "number the sets in a column Set"
            )
        return self._isotherms()

    def _isotherms(self) -> tuple[Table, ...]:
        values = self["temperature"]
        order = np.argsort(values, kind="stable")
        starts = np.flatnonzero(np.diff(values[order]) > _SAME_TEMPERATURE) + 1
        groups = np.split(order, starts)
        for group in groups:
            if np.ptp(values[group]) > _WIDEST_SET:
                low, high = in_celsius(values[group].min()), in_celsius(values[group].max())
                raise ValueError(
                    f"{self.source.name}: temperatures from {low:.4g} to {high:.4g} °C without a "
                    "gap of 1 K cannot be distinguished; number the sets in a column Set"
                )
        self._refuse_few_beginnings(len(groups))
        return tuple(self._rows(np.sort(group)) for group in groups)

    def _refuse_few_beginnings(self, count: int) -> None:
        """Refuse sets over time of which most go on with the time of the one before."""
        if "time" not in self or "angular_frequency" in self:
            return
        back = np.flatnonzero(np.diff(self["time"]) <= 0)
        if 0 < back.size < count - 1:
            row = int(back[0])
            before, after = (format_quantity(self["time"][at], "s") for at in (row, row + 1))
            raise ValueError(
                f"{self.source.name}:{self.lines[row + 1]}: time goes from {before} back to "
                f"{after}, and goes on from one temperature to the next elsewhere; correct the "
                "times if this is one test whose temperature varies, or number the sets in a "
                "column Set"
            )

    def _rows(self, which: Bools | NDArray[np.int64]) -> Table:
        columns = {name: read_only(values[which]) for name, values in self.columns.items()}
        return Table(
            self.source, columns, self.data, self.headings, self.lines[which], self.left_out
        )

    def ascending(self, quantity: str) -> Table:
        """Return the table in reverse order if a column falls from row to row; else unchanged.

        Instruments that begin with the slowest cycle write their rows so. Rows in no order are
        left as they are.
        """
        values = self[quantity]
        falls = len(self) > 1 and bool(np.all(np.diff(values) < 0))
        return self._rows(np.arange(len(self))[::-1]) if falls else self

    def located(self, error: Exception | str) -> str:
        """Return a message that counts rows from 0 in lines of the file.

        Parameters
        ----------
        error : Exception or str
            The message of a law or a fit: "TabulatedCreep.times, row 3: ...".

        Returns
        -------
        str
            The message with "line 5 of pmma.csv" in place of "row 3".
        """

        def line(match: re.Match[str]) -> str:
            row = int(match[1])
            if row >= len(self):
                return match[0]
            return f"line {self.lines[row]} of {self.source.name}"

        return re.sub(r"\brow (\d+)", line, str(error))


def read_only(values: Floats) -> Floats:
    """Return the values, protected against writing."""
    values.flags.writeable = False
    return values
