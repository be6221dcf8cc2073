"""Profiles by their names: the front door to the nouns."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Mapping
from inspect import signature
from typing import Any

import numpy as np

from viscontact.indenters.chamfer import Chamfer
from viscontact.indenters.crowns import CylindricalProfile, FullCrown, PartialCrown, TwoRadiiCrown
from viscontact.indenters.logarithmic import LogarithmicProfile
from viscontact.indenters.profile import Profile
from viscontact.indenters.tabulated import TabulatedProfile

#: What makes a profile, by its name; of its arguments the roller has some.
PROFILES: dict[str, Callable[..., Profile]] = {
    "cylindrical": CylindricalProfile,
    "full": FullCrown,
    "partial": PartialCrown,
    "two-radii": TwoRadiiCrown,
    "chamfer": Chamfer,
    "logarithmic": LogarithmicProfile,
    "lundberg": LogarithmicProfile.lundberg,
    "johns-gohar": LogarithmicProfile.johns_gohar,
    "fujiwara-kawase": LogarithmicProfile.fujiwara_kawase,
    "iso-16281": LogarithmicProfile.iso_16281,
    "table": TabulatedProfile,
}


def named_profile(name: str, of_roller: Mapping[str, Any], arguments: Mapping[str, Any]) -> Profile:
    """Make a profile from its name and its arguments.

    Parameters
    ----------
    name : str
        A key of `PROFILES`.
    of_roller : mapping
        What the roller knows already, by the names of arguments: its lengths [m]; None for what
        it does not.
    arguments : mapping
        The profile's own.

    Returns
    -------
    Profile
        The profile.

    Raises
    ------
    ValueError
        If the name or an argument is unknown, one is missing, or makes no sense.

    Examples
    --------
    >>> named_profile("iso-16281", {"radius": 5e-3, "half_length": 6e-3}, {}).crown_ratio
    1.0
    """
    make = PROFILES.get(name)
    if make is None:
        near = difflib.get_close_matches(name, PROFILES, n=1)
        hint = f"; did you mean {near[0]!r}?" if near else "."
        raise ValueError(
            f"roller profile {name!r} is unknown{hint} The names are "
            f"{', '.join(map(repr, PROFILES))}; a table of (x, drop) or a profile may stand there"
        )
    takes = signature(make).parameters
    unknown = [key for key in arguments if key not in takes]
    if unknown:
        own = [key for key in takes if of_roller.get(key) is None] or ["none"]
        raise ValueError(
            f"roller profile {name!r} has no {unknown[0]}; its arguments are {', '.join(own)}"
        )
    known = {key: value for key, value in of_roller.items() if value is not None and key in takes}
    given = known | dict(arguments)
    missing = [
        key for key, each in takes.items() if each.default is each.empty and key not in given
    ]
    if missing:
        raise ValueError(f"roller profile {name!r} needs {', '.join(missing)}")
    return make(**given)


def profile_from_table(table: object) -> Profile:
    """Make a profile from rows of (x, drop).

    Parameters
    ----------
    table : array_like, shape (n, 2)
        Positions and drops, as for `TabulatedProfile` [m].

    Returns
    -------
    Profile
        Smooth between the points.

    Raises
    ------
    ValueError
        If it is no such table.

    Examples
    --------
    >>> float(profile_from_table([(0, 0), (1e-3, 0), (2e-3, 1e-6)]).drop(2e-3, 2e-3))
    1e-06
    """
    try:
        rows = np.asarray(table)
    except ValueError as error:
        raise ValueError(f"roller profile: rows of (x, drop) are wanted, {error}") from error
    if rows.ndim != 2 or rows.shape[1] != 2:
        raise ValueError(
            "roller profile must be a name, a profile, or rows of (x, drop) in m, got "
            f"{table!r:.60}"
        )
    return TabulatedProfile(rows[:, 0], rows[:, 1])
