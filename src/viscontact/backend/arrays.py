"""Types of arrays, by the kind of their numbers."""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

#: Real numbers in double precision.
Floats = NDArray[np.float64]
#: Real numbers in single precision, which the search for a contact uses.
Singles = NDArray[np.float32]
#: Complex numbers in double precision.
Complexes = NDArray[np.complex128]
#: Masks.
Bools = NDArray[np.bool_]
#: Indices and counts.
Integers = NDArray[np.intp]
#: Small whole numbers, each of which stands for a named state.
Flags = NDArray[np.int8]
#: Type of a field over the grid: numbers or a mask.
Field = TypeVar("Field", Floats, Bools)
#: Numbers of any kind: real or complex, in single or double precision.
Numbers = NDArray[Any]
