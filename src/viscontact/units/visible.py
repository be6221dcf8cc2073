"""Control characters in texts of users, which would act on a terminal or break a drawing."""

from __future__ import annotations

import re

#: C0 (not tabs and new lines), C1, changes of the direction of writing, and parts of characters.
_CONTROLS = re.compile("[\0-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\ud800-\udfff]")


def visible(text: str) -> str:
    r"""Return a text with its control characters as escapes, such as ``\x1b``.

    >>> visible("5 µm\x07")
    '5 µm\\x07'
    """
    return _CONTROLS.sub(lambda found: ascii(found[0])[1:-1], text)
