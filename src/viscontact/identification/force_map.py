"""All force curves of one file, with their places."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from pathlib import Path

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.identification.force_curve import ForceCurve
from viscontact.identification.instrument_curves import (
    is_instrument_file,
    read_apart,
    recorded_curve,
    split_number,
)
from viscontact.identification.instrument_reader import count_curves, read_all

#: Those that may hold several curves.
_MAPS = (".jpk-force-map", ".jpk-qi-data", ".jpk-qi-series", ".h5")

#: What is read of a curve.
_COLUMNS = ("time", "position", "force")


@dataclass(frozen=True, eq=False, repr=False)
class ForceMap:
    """Force curves of a file, of `read_force_map`.

    Attributes
    ----------
    curves : dict of str to ForceCurve
        The curves, as "map.jpk-force-map#12": the number begins at 0.
    places : dict of str to (float, float)
        Places x and y of those whose place is known [m].
    failures : dict of str to str
        Why the other curves cannot be read.

    Examples
    --------
    >>> ForceMap({}, {}, {"a.h5#0": "a.h5: states no time"}).failures["a.h5#0"]
    'a.h5: states no time'
    """

    curves: Mapping[str, ForceCurve]
    places: Mapping[str, tuple[float, float]]
    failures: Mapping[str, str]

    def __repr__(self) -> str:
        return (
            f"ForceMap: {len(self.curves)} curves, {len(self.places)} with places, "
            f"{len(self.failures)} that cannot be read"
        )


def count_force_curves(path: str | PathLike[str]) -> int:
    """Return the number of curves in a file of an instrument; 1 for a curve that is named.

    Parameters
    ----------
    path : path-like
        The file, with or without the number of a curve.

    Returns
    -------
    int
        The number of curves.

    Raises
    ------
    ValueError
        If afmformats is missing or cannot read the file.
    OSError
        If there is no such file.

    Examples
    --------
    >>> count_force_curves("cell.jpk-force")
    1
    """
    file, number = split_number(Path(path))
    if number is not None or file.suffix.lower() not in _MAPS:
        return 1
    return int(read_apart(file, count_curves).values)


def read_force_map(path: str | PathLike[str], *, spring_constant: float | None = None) -> ForceMap:
    """Read all force curves of a file of an atomic force microscope, with their places.

    Parameters
    ----------
    path : path-like
        The file, as for `read_force_curve`.
    spring_constant : float, optional
        Spring constant [N/m], as there.

    Returns
    -------
    ForceMap
        The curves, and what is wrong with those that cannot be read.

    Raises
    ------
    ValueError
        If afmformats is missing or cannot read the file.
    OSError
        If there is no such file.

    Examples
    --------
    >>> gel = read_force_map("gel.jpk-force-map")  # doctest: +SKIP
    >>> fits = fit_each(fit, gel.curves, places=gel.places)  # doctest: +SKIP
    """
    file = Path(path)
    if not is_instrument_file(file):
        raise ValueError(
            f"{file.name}: is no file of an instrument; read_force_curve reads a table, which has "
            "one curve"
        )
    found = read_apart(file, read_all, spring_constant)
    curves, places, failures = {}, {}, {}
    for number, stated in enumerate(found.values):
        name = f"{file.name}#{number}"
        if stated["place"] is not None:
            places[name] = (stated["place"][0], stated["place"][1])
        if stated["failure"]:
            failures[name] = stated["failure"]
            continue
        columns = {each: found.arrays[f"{number} {each}"] for each in _COLUMNS}
        try:
            curves[name] = recorded_curve(file, stated["spring constant"], columns, spring_constant)
        except ValueError as error:
            failures[name] = str(error)
    return ForceMap(curves, places, failures)
