"""What a run carries from step to step, as plain data that a file can hold.

Whatever remembers something between two steps of a run says what by ``restart_data()``, and goes
on from it after ``restore(restart_data)``, to the last bit. Nothing else may outlast a step.
"""

from __future__ import annotations

from typing import Any

#: Arrays, numbers, texts and None, in lists and dicts with texts as keys.
RestartData = dict[str, Any]
