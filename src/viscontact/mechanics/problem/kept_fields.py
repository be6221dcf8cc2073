"""Choice of the instants or speeds whose fields a result keeps."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads.steady_motion import checked_speeds
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import real_array


@dataclass(frozen=True, eq=False)
class KeptFields:
    """Fields that a result keeps, as requested: "all", "none", or instants [s] or speeds [m/s].

    >>> KeptFields([0.0, 2.0]).among(np.array([0.0, 1.0, 2.0])).tolist()
    [0.0, 2.0]
    >>> KeptFields("all").axis(), KeptFields([0.0, 2.0]).axis()
    ('time', 'field_time')
    """

    requested: str | Sequence[float] = "all"

    @property
    def places(self) -> Sequence[float]:
        """Instants [s] or speeds [m/s] that are named one by one."""
        return () if isinstance(self.requested, str) else self.requested

    def axis(self, over: str = "time") -> str:
        """Return the dimension of the fields of a result over time or speed."""
        # An array is not to be compared with a word.
        keeps_all = isinstance(self.requested, str) and self.requested == "all"
        return over if keeps_all else f"field_{over}"

    def among(self, places: Floats, over: str = "time") -> Floats:
        """Return those of a run's instants [s] or speeds [m/s] whose fields are kept."""
        if not isinstance(self.requested, str):
            return (_instants if over == "time" else _speeds)(self.requested, places)
        if self.requested not in ("all", "none"):
            others = "instants in s" if over == "time" else "speeds"
            raise ValueError(f"fields must be 'all', 'none' or {others}, got {self.requested!r}")
        return places if self.requested == "all" else places[:0]


ALL_FIELDS, NO_FIELDS = KeptFields("all"), KeptFields("none")


def _instants(requested: Sequence[float], times: Floats) -> Floats:
    """Times of a run nearest to requested ones, which must be among them [s]."""
    wanted = np.unique(real_array("fields", requested, "s"))
    index = np.clip(np.searchsorted(times, wanted), 0, len(times) - 1)
    index -= (index > 0) & (np.abs(times[index - 1] - wanted) < np.abs(times[index] - wanted))
    strange = ~np.isclose(times[index], wanted, rtol=1e-9, atol=0.0)
    if strange.any():
        raise ValueError(
            f"fields: {format_quantity(wanted[strange][0], 's', 6)} is not among the run's times; "
            f"the nearest is {format_quantity(times[index][strange][0], 's', 6)}"
        )
    return times[index]


def _speeds(requested: Sequence[float], speeds: Floats) -> Floats:
    """Requested speeds, which must be among those of a run [m/s]."""
    kept = checked_speeds("fields", requested)
    if not np.isin(kept, speeds).all():
        raise ValueError(f"fields must be some of the speeds {speeds.tolist()}, got {requested!r}")
    return kept
