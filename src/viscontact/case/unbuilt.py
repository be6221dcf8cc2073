"""What case files will hold one day: refused by name until it is built."""

from __future__ import annotations

#: Values of the key that says what a section is.
VALUES: dict[str, frozenset[str]] = {
    "shape": frozenset({"height-map"}),
}

#: Keys by section, with what to do instead.
KEYS: dict[str, dict[str, str]] = {
    "indenter": {
        "file": "measured maps can be pressed from Python with viscontact.HeightMap",
    },
}


def refused_value(key: str, value: object, built: list[str]) -> str | None:
    """Return why a known value is refused, or None if it is not known either.

    Parameters
    ----------
    key : str
        The key that says what a section is.
    value : object
        What stands there.
    built : list of str
        What may stand there.

    Examples
    --------
    >>> refused_value("shape", "height-map", ["cone", "sphere"])
    "'height-map' is not built yet; built: cone, sphere"
    """
    if value not in VALUES.get(key, ()):
        return None
    return f"{value!r} is not built yet; built: {', '.join(built)}"


def refused_key(section: object, key: object) -> str | None:
    """Return why a known key is refused, or None if it is not known either.

    Parameters
    ----------
    section, key : object
        The name of the section, and the key in it.

    Examples
    --------
    >>> refused_key("indenter", "file")
    'is not built yet; measured maps can be pressed from Python with viscontact.HeightMap'
    """
    remedy = KEYS.get(str(section), {}).get(str(key))
    return f"is not built yet; {remedy}" if remedy else None
