"""The compiled core, where there is one: `core` is the extension module, or None.

What has a twin in the core takes that, and computes with NumPy without it::

    from viscontact.backend import compiled

    def largest_of(field):
        return compiled.core.largest(field) if compiled.core else float(abs(field).max())

The environment variable ``VISCONTACT_CORE`` may be ``off``, to compute with NumPy, or
``required``, to fail without the core. Sources are in ``src/core`` of a checkout.
"""

from __future__ import annotations

import os
from types import ModuleType

from viscontact.backend.errors import CoreError

#: Environment variable that chooses, and its values; empty: the core is used where it is.
VARIABLE = "VISCONTACT_CORE"
CHOICES = ("", "off", "required")
#: Counts changes of what functions of the core take, return or mean, as `INTERFACE` there.
INTERFACE = 6

_choice = os.environ.get(VARIABLE, "")
if _choice not in CHOICES:
    raise CoreError(f"{VARIABLE} must be 'off', 'required' or not set, got {_choice!r}")

#: The compiled core, None without one; and why there is none.
core: ModuleType | None = None
absent = ""
try:
    if _choice == "off":
        raise ImportError(f"{VARIABLE} is off")
    # Not `from viscontact.backend import`, which does not tell a missing module from a faulty one.
    import viscontact.backend._core as _core

    if _core.INTERFACE != INTERFACE:  # a checkout was renewed, and its core not yet
        raise ImportError("it was built of other sources")
    core = _core
except ImportError as _error:
    # Systems name the file first, and then what is wrong with it.
    absent = str(_error).rsplit(": ", 1)[-1]
    if isinstance(_error, ModuleNotFoundError):
        absent = "it is not built"
    if _choice == "required":
        raise CoreError(
            f"{VARIABLE} is 'required', and there is no compiled core: {absent};"
            " unset it to compute with NumPy"
        ) from _error


#: Names of what computes inner loops, as results and records of runs state them.
NUMPY, COMPILED = "numpy", "compiled"


def fastest_inner_loops() -> str:
    """Return the name of the fastest inner loops that are there: "compiled", or "numpy".

    Examples
    --------
    >>> fastest_inner_loops() in {"compiled", "numpy"}
    True
    """
    return COMPILED if core else NUMPY


def core_by(name: str) -> ModuleType | None:
    """Return the core for inner loops of a name, None for those of NumPy.

    The two agree to rounding, not to the bit, so that a run keeps those that it began with.

    Raises
    ------
    ValueError
        If there is no core, or the name is unknown.

    Examples
    --------
    >>> core_by("numpy") is None
    True
    """
    if name not in (NUMPY, COMPILED):
        raise ValueError(f"no inner loops are called {name!r}; known are {NUMPY} and {COMPILED}")
    if name == COMPILED and core is None:
        raise ValueError(
            f"there is no compiled core: {absent}; install viscontact from a wheel, or where there "
            f"is a C++ compiler, and do not set {VARIABLE}=off"
        )
    return core if name == COMPILED else None


def kernels() -> str:
    """Return what computes the inner loops of a run, and why it is not the compiled core.

    Examples
    --------
    >>> kernels().split(" ")[0] in {"compiled", "NumPy"}
    True
    """
    return "compiled" if core else f"NumPy (no compiled core: {absent})"
