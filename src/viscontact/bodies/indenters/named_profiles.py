"""Roller profiles by name."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Mapping
from inspect import signature
from typing import Any

from viscontact.bodies.indenters.chamfer import Chamfer
from viscontact.bodies.indenters.crowns import (
    CylindricalProfile,
    FullCrown,
    PartialCrown,
    TwoRadiiCrown,
)
from viscontact.bodies.indenters.logarithmic import LogarithmicProfile
from viscontact.bodies.indenters.profile import Profile
from viscontact.bodies.indenters.tabulated import TabulatedProfile
from viscontact.units.numbers import real_array

#: Constructors of profiles by name; some of their arguments come from the roller.
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
    """Make the profile `name`, a key of `PROFILES`, from its arguments or those `of_roller`.

    Unknown ones of the roller are None. ValueError if one is unknown, missing or invalid.
    """
    make = PROFILES.get(name)
    if make is None:
        near = difflib.get_close_matches(name, PROFILES, n=1)
        hint = f"; did you mean {near[0]!r}?" if near else "."
        raise ValueError(
            f"roller profile {name!r} is unknown{hint} The names are "
            f"{', '.join(map(repr, PROFILES))}; or give a table of (x, drop) or a profile"
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
    """Make a smooth `TabulatedProfile` from rows of (x, drop), shape (n, 2) [m]."""
    rows = real_array("roller profile: rows of (x, drop)", table, "m")
    if rows.ndim != 2 or rows.shape[1] != 2:
        raise ValueError(
            "roller profile must be a name, a profile, or rows of (x, drop) in m, got "
            f"{table!r:.60}"
        )
    return TabulatedProfile(rows[:, 0], rows[:, 1])
