"""The shipped library of materials: a YAML file each, with source, range and measured points.

`README.md` beside the files says what an entry holds, and what was refused and why.
"""

from viscontact.materials.library.entry import Entry, entry, names
from viscontact.materials.library.points import Points

__all__ = ["Entry", "Points", "entry", "names"]
