"""Bodies that end, on one grid, for tests of their operators and of the stresses inside."""

from __future__ import annotations

from viscontact.bodies.grid import Grid

GRID = Grid((44, 32), (4.4, 1.6))

#: Places of planes along x, and which of them are free.
ENDS = {
    "one end": ((-2.0, None), (True, False)),
    "the other end": ((None, 2.0), (False, True)),
    "two free ends": ((-2.0, 2.0), (True, True)),
    "end and wall": ((-2.0, 2.0), (True, False)),
    "wall and end": ((-2.0, 2.0), (False, True)),
}
