"""How a noun shows itself: a drawing and a table in a notebook, a table when it is printed."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    viscontact: Any  # type checkers see no cycle: most public classes derive from `Displayable`
else:
    import viscontact


class Displayable:
    """A noun that can tell what it is, in readable units.

    Notebooks ask for `_repr_html_`, ``print`` for ``str``; ``repr`` stays the dataclass's own,
    which can be typed in again.

    Notes
    -----
    What is shown is made high up, where units and drawings are, and these nouns stand on the
    ground. So the noun asks the front door, ``viscontact``, which loads by name, and late, what
    lives on any floor: this is the one module below the shell that may. Writing the tables down
    here would bring units to the ground floor; telling IPython of every type would serve IPython
    alone, and not the other programs that call `_repr_html_`.
    """

    __slots__ = ()

    def _repr_html_(self) -> str:
        return str(viscontact.notebook.display_html(self))

    def __str__(self) -> str:
        return str(viscontact.notebook.display_text(self))


def result_plots(result: object) -> Any:
    """Return the figures of a result, `viscontact.plot.ResultPlots`, in the same late way."""
    return viscontact.plot.ResultPlots(result)


class DisplayableGroup(Displayable, ABC):
    """A noun made of others, which are shown one below the other."""

    __slots__ = ()

    @property
    @abstractmethod
    def display_title(self) -> str:
        """What stands above."""

    @abstractmethod
    def display_parts(self) -> dict[str, Displayable | str]:
        """Return the nouns it is made of, and what else is told of it in words, by their names."""
