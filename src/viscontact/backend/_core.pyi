"""Compiled twins of functions of the package; sources in ``src/core``."""

from viscontact.backend.arrays import Numbers

#: Counts changes of what functions take, return or mean.
INTERFACE: int
#: Hash of the sources that it was compiled of.
SOURCES: str

def largest(array: Numbers) -> float: ...
