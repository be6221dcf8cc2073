"""Message for a name that is not in the library."""

from __future__ import annotations

import difflib
import re

from viscontact.bodies.materials.library.entry import entry, names


def nearest_names(name: str) -> list[str]:
    """Return at most three shipped materials that a name such as ``"POM"`` may mean."""
    # Words of names begin with it, else words of title or family, else the most similar name.
    query = re.sub(r"[\s_-]+", " ", name.strip().lower())
    if not query:
        return []
    # At the beginning of a word only: "PU" is not in "computed", nor "PE" in "paper".
    begins = re.compile(rf"\b{re.escape(query)}")
    within = [each for each in names() if begins.search(each.replace("-", " "))]
    within = within or [
        each
        for each in names()
        if begins.search(f"{entry(each).title} {entry(each).family}".lower())
    ]
    return within[:3] or difflib.get_close_matches(name.strip().lower(), names(), n=1)


def unknown_name(name: str, kind: str = "shipped material") -> str:
    """Return the message for an unknown name: similar names, all names, and the alternative.

    Parameters
    ----------
    name : str
        A name that is not in the library.
    kind : str, optional
        What was sought under this name.

    Returns
    -------
    str
        A message of one line.

    Examples
    --------
    >>> unknown_name("POM").partition(" There are")[0]
    "no shipped material is called 'POM'; did you mean 'pom-c-23c'?"
    """
    near = nearest_names(name)
    hint = f"; did you mean {' or '.join(map(repr, near))}?" if near else "."
    return (
        f"no {kind} is called {name!r}{hint} There are {', '.join(names())}; or describe your "
        "own, such as {law: elastic, youngs_modulus: 210 GPa, poisson_ratio: 0.3}, or one that "
        "creeps: see 'Bring your creep data' in the manual (howto/creep-data)"
    )
