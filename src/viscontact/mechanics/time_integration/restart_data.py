"""Restart data: the state between two steps as plain data that a file can hold.

Objects that keep a state from step to step return it by ``restart_data()``, and continue from it
after ``restore(restart_data)`` with the same bits.
"""

from __future__ import annotations

from typing import Any

#: Arrays, numbers, strings and None, in lists and dicts with strings as keys.
RestartData = dict[str, Any]
