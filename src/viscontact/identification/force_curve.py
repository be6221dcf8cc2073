"""Force curve of an atomic force microscope: deflection of the cantilever over piezo position."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.series_fits.columns import columns_over_time
from viscontact.tables import Table
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import positive, store

_LEAST_ROWS = 20


@dataclass(frozen=True, eq=False, repr=False)
class ForceCurve:
    """Deflection of a cantilever over the position of its base, before and in contact.

    Parameters
    ----------
    times : array_like, shape (n,)
        Instants, never falling [s].
    position : array_like, shape (n,)
        Position of the base along its way to the sample [m], from any origin. A height above the
        sample, which falls during the approach, is turned over.
    deflection : array_like, shape (n,)
        Deflection of the cantilever [m], positive when it is pushed away from the sample, from any
        zero: signal in volts times sensitivity, or force over spring constant.
    spring_constant : float
        Spring constant of the cantilever [N/m].

    Raises
    ------
    ValueError
        If a value is not finite or a time falls, naming its row; if lengths differ, rows are fewer
        than 20, or the spring constant is not positive.

    Examples
    --------
    >>> times = np.linspace(0.0, 1.0, 21)
    >>> bent = 1e-8 * np.maximum(times - 0.5, 0.0)
    >>> curve = ForceCurve(times, -1e-6 * times, bent, spring_constant=0.1)  # a falling height
    >>> float(curve.position[-1]), curve.loading_rows
    (1e-06, 21)
    """

    times: Floats
    position: Floats
    deflection: Floats
    spring_constant: float

    def __post_init__(self) -> None:
        columns = columns_over_time(
            "ForceCurve",
            _LEAST_ROWS,
            times=(self.times, "s"),
            position=(self.position, "m"),
            deflection=(self.deflection, "m"),
        )
        stiffness = positive("ForceCurve: spring_constant", self.spring_constant, "N/m")
        if _is_falling(columns["position"], columns["deflection"]):
            columns["position"] = -columns["position"]
        store(self, **columns, spring_constant=stiffness)

    def __repr__(self) -> str:
        duration = format_quantity(float(np.ptp(self.times)), "s")
        return (
            f"ForceCurve: {self.times.size} rows over {duration}, "
            f"{format_quantity(self.spring_constant, 'N/m')}"
        )

    @property
    def loading_rows(self) -> int:
        """Number of rows up to the first one at which the position is (nearly) largest."""
        largest, extent = self.position.max(), np.ptp(self.position)
        return int(np.argmax(self.position >= largest - 1e-3 * extent)) + 1


def tabulated_curve(
    table: Table, spring_constant: float, sensitivity: float | None = None
) -> ForceCurve:
    """Return the force curve of a table of time, position, and deflection, force or signal.

    Spring constant [N/m]; `sensitivity` is the deflection per signal [m/V]. ValueError for a
    missing column or an invalid curve.
    """
    found = [name for name in ("deflection", "force", "signal") if name in table]
    if not {"time", "position"} <= set(table.columns) or not found:
        raise ValueError(
            f"{table.source.name}: a force curve has columns time, position, and deflection or "
            f"force; {table.contents}"
        )
    if found[0] == "signal" and sensitivity is None:
        raise ValueError(
            f"{table.source.name}: a deflection in volts needs the sensitivity, such as 50 nm/V"
        )
    scale = {"deflection": 1.0, "force": 1.0 / spring_constant, "signal": sensitivity or 0.0}
    deflection = scale[found[0]] * table[found[0]]
    return ForceCurve(table["time"], table["position"], deflection, spring_constant)


def _is_falling(position: Floats, deflection: Floats) -> bool:
    """True if the position falls on the way to the largest deflection."""
    peak = int(
        np.argmax(np.abs(deflection - np.median(deflection[: max(deflection.size // 10, 3)])))
    )
    return bool(position[peak] < position[0])
