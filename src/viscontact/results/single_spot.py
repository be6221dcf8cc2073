"""Contacts that are obviously a single spot, without SciPy."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools
from viscontact.results.stored_contact import cells_in_contact
from viscontact.results.stored_result import StoredResult


def ends_in_one_spot(stored: StoredResult) -> bool:
    """True if the last stored contact is obviously one spot, or if there is no stored contact."""
    if "pressure" not in stored or "gap" not in stored:
        return True
    for row in reversed(range(stored.sizes[stored["pressure"].dims[0]])):
        contact: Bools = cells_in_contact(stored, row)
        if contact.any():
            return is_one_spot(contact)
    return True


def is_one_spot(contact: Bools) -> bool:
    """True if each line of a region is one piece, and next to that of the next line."""
    # Such a region is a single spot; another one may be.
    lines = np.flatnonzero(contact.any(axis=1))
    if not lines.size or lines.size != lines[-1] - lines[0] + 1:
        return False
    inside = contact[lines]
    first = inside.argmax(axis=1)
    last = inside.shape[1] - 1 - inside[:, ::-1].argmax(axis=1)
    is_whole = inside.sum(axis=1) == last - first + 1
    overlap = np.minimum(last[1:], last[:-1]) >= np.maximum(first[1:], first[:-1])
    return bool(is_whole.all() and overlap.all())
