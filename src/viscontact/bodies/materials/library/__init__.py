"""Library of materials: one YAML file each, with source, range and measured points.

`README.md` in this folder describes the content of an entry, and which data were not accepted.
"""

from viscontact.bodies.materials.library.entry import Entry, entry, names
from viscontact.bodies.materials.library.points import Points
from viscontact.bodies.materials.library.unknown_names import unknown_name

__all__ = ["Entry", "Points", "entry", "names", "unknown_name"]
