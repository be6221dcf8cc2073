"""Filters of fields by their spectra in the compiled core: two transforms and back in one call."""

from __future__ import annotations

from types import ModuleType

import numpy as np

from viscontact.backend.arrays import Floats, Numbers
from viscontact.backend.team import Team, Workspace
from viscontact.backend.transforms import Field, fast_length, largest_of


class CompiledFilter:
    """Fields whose spectrum is multiplied by a real symbol, even along both axes.

    Lines of a field are padded with zeros to the `lengths` of their Fourier transforms; along an
    `even` axis the field is one side of an even one, and these are its cosine transforms (DCT-II).
    """

    def __init__(
        self,
        core: ModuleType,
        shape: tuple[int, int],
        lengths: tuple[int, int],
        even: tuple[bool, bool],
        symbol: Numbers,
        single: bool,
        team: Team,
    ) -> None:
        of = core.SingleFilter if single else core.DoubleFilter
        given = np.ascontiguousarray(symbol, np.float64)
        #: The filter of the core itself.
        self.of_core = of(shape, lengths, even, given, team.threads)
        self._shape, self._waves = shape, given.shape
        self._number = np.dtype(np.float32 if single else np.float64)
        self._kinds = {self._number, np.dtype(np.float64)}
        self._work = (self.of_core.work,), self._number

    @property
    def symbol(self) -> Floats:
        """The symbol, of the precision of the filter, in an array of its own."""
        found = np.empty(self._waves)
        self.of_core.read_symbol(found)
        return found

    def apply(self, field: Field, into: Field | None, workspace: Workspace | None) -> Field:
        """Return the filtered field, in an array if one is given."""
        result = np.empty(self._shape) if into is None else into
        kind = field.dtype if field.dtype in self._kinds else self._number
        given = field if self._fits(field) else np.ascontiguousarray(field, kind)
        # Single precision has few exponents: numbers of another kind become of order one.
        size = 1.0 if given.dtype == self._number else largest_of(given) or 1.0
        found = result if self._fits(result) else np.empty(self._shape, self._number)
        work = workspace.array(*self._work) if workspace else np.empty(*self._work)
        self.of_core.apply(given, size, found, work)
        if found is not result:
            result[...] = found
        return result

    def _fits(self, field: Field) -> bool:
        """True if the core takes a field as it is."""
        return field.dtype in self._kinds and field.strides[1] == field.itemsize


def compiled_filter(
    team: Team,
    shape: tuple[int, int],
    lengths: tuple[int, int],
    even: tuple[bool, bool],
    symbol: Numbers,
    *,
    single: bool,
) -> CompiledFilter | None:
    """Return a filter of the team's core; None where that has none for these lengths or symbol.

    Examples
    --------
    >>> compiled_filter(Team(), (2, 2), (2, 2), (True, True), np.ones((2, 2)), single=False)
    """
    is_fast = all(fast_length(length) == length for length in lengths)
    if team.core is None or not is_fast or symbol.dtype.kind != "f":
        return None
    return CompiledFilter(team.core, shape, lengths, even, symbol, single, team)
