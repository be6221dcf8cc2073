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

from viscontact.backend.errors import CoreError

#: Environment variable that chooses, and its values; empty: the core is used where it is.
VARIABLE = "VISCONTACT_CORE"
CHOICES = ("", "off", "required")
#: Counts changes of what functions of the core take, return or mean, as `INTERFACE` there.
INTERFACE = 1

_choice = os.environ.get(VARIABLE, "")
if _choice not in CHOICES:
    raise CoreError(f"{VARIABLE} must be 'off', 'required' or not set, got {_choice!r}")

#: Why there is no core; empty if there is one.
absent = ""
try:
    if _choice == "off":
        raise ImportError(f"{VARIABLE} is off")
    import viscontact.backend._core as core

    if core.INTERFACE != INTERFACE:  # a checkout was renewed, and its core not yet
        raise ImportError("it was built of other sources")
except ImportError as _error:
    core = None  # type: ignore[assignment]
    # Systems name the file first, and then what is wrong with it.
    absent = str(_error).rsplit(": ", 1)[-1]
    if isinstance(_error, ModuleNotFoundError):
        absent = "it is not built"
    if _choice == "required":
        raise CoreError(
            f"{VARIABLE} is 'required', and there is no compiled core: {absent};"
            " unset it to compute with NumPy"
        ) from _error


def kernels() -> str:
    """Return what computes the inner loops of a run, and why it is not the compiled core.

    Examples
    --------
    >>> kernels().split(" ")[0] in {"compiled", "NumPy"}
    True
    """
    return "compiled" if core else f"NumPy (no compiled core: {absent})"
