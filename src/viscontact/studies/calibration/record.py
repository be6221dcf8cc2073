"""Contact record: force and approach of a body over time, as measured."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import Literal

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads.history import Control
from viscontact.bodies.series_fits.columns import columns_over_time
from viscontact.tables import GivenColumns, read_table
from viscontact.units.numbers import store

_LEAST_ROWS = 5


@dataclass(frozen=True, eq=False)
class ContactRecord:
    """Force, approach or both over time, measured on any pair of bodies.

    Parameters
    ----------
    times : array_like, shape (n,)
        Instants, never falling; one that comes twice is a jump [s].
    force : array_like, shape (n,), optional
        Force, positive in compression; scatter may make it negative near 0 [N].
    approach : array_like, shape (n,), optional
        Reading of the approach, positive when the bodies come closer [m].
    name : str, optional
        Name of the record in messages.

    Raises
    ------
    ValueError
        If there is neither force nor approach, columns differ in length, a value is not finite, a
        time falls, or there are fewer than five rows.

    Examples
    --------
    >>> times = np.linspace(0.0, 1.0, 6)
    >>> record = ContactRecord(times, force=2.0 * times, approach=1e-6 * times)
    >>> record.columns, float(record.force[-1])
    (('force', 'approach'), 2.0)
    """

    times: Floats
    force: Floats | None = None
    approach: Floats | None = None
    name: str = "record"

    def __post_init__(self) -> None:
        if not self.columns:
            raise ValueError(f"{self.name}: needs a column force or approach beside the time")
        given = {
            name: (self.column(name), "N" if name == "force" else "m") for name in self.columns
        }
        store(self, **columns_over_time(self.name, _LEAST_ROWS, times=(self.times, "s"), **given))
        steps = np.diff(self.times)
        for row in np.flatnonzero((steps[:-1] == 0) & (steps[1:] == 0))[:1]:
            raise ValueError(
                f"{self.name}: times, row {row + 2}: comes three times; a jump has two rows, "
                "before and after it"
            )

    @property
    def columns(self) -> tuple[Control, ...]:
        """Quantities that were measured."""
        names: tuple[Control, ...] = ("force", "approach")
        return tuple(name for name in names if getattr(self, name) is not None)

    def column(self, name: str) -> Floats:
        """Return force [N] or approach [m]."""
        values: Floats | None = getattr(self, name)
        assert values is not None  # named by `columns`
        return values

    def thinned(self, rows: int) -> ContactRecord:
        """Return the record as means over equal numbers of rows; first rows and jumps are kept."""
        count = self.times.size
        if count <= rows:
            return self
        jumps = np.flatnonzero(np.diff(self.times) == 0)
        cuts = np.linspace(1, count, rows).astype(int)
        cuts = np.unique(np.concatenate([[0, 1], cuts, jumps, jumps + 1, jumps + 2]))
        starts = cuts[cuts < count]
        sizes = np.diff(np.append(starts, count))
        means = {n: np.add.reduceat(self.column(n), starts) / sizes for n in self.columns}
        times = np.add.reduceat(self.times, starts) / sizes
        return ContactRecord(times, means.get("force"), means.get("approach"), self.name)


def read_record(path: str | PathLike[str], names: GivenColumns = None) -> ContactRecord:
    """Read a record: columns time, and force or approach; ValueError names the line."""
    table = read_table(path, names, wanted=("force", "approach"))
    columns = {name: table[name] for name in ("force", "approach") if name in table}
    if not columns:
        raise ValueError(
            f"{table.source.name}: needs a column force or approach beside the time; "
            f"{table.contents}"
        )
    try:
        return ContactRecord(table["time"], **columns, name=Path(table.source).name)
    except ValueError as error:
        raise ValueError(table.located(error)) from None


#: What drives a run: a column of the record, or the load of the case.
Drive = Literal["force", "approach", "case"]


def chosen_drive(record: ContactRecord, control: Control, wanted: str | None) -> Drive:
    """Drive of a record's run, whose case controls force or approach; or ValueError."""
    drive = wanted or (control if control in record.columns else "case")
    compared = compared_column(drive, control)
    for name, use in ((drive, "prescribed"), (compared, "compared")):
        if name != "case" and name not in record.columns:
            raise ValueError(
                f"{record.name}: has no column {name}, which is to be {use}; there is "
                f"{' and '.join(('time', *record.columns))}"
            )
    found: dict[str, Drive] = {"force": "force", "approach": "approach", "case": "case"}
    return found[drive]


def compared_column(drive: str, control: Control) -> Control:
    """Column that a run is compared with: not the prescribed one."""
    prescribed = control if drive == "case" else drive
    return "approach" if prescribed == "force" else "force"
