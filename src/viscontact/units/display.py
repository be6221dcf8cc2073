"""Rich display in notebooks (`_repr_html_`) and terminals (`str`)."""

from __future__ import annotations

from abc import ABC, abstractmethod
from os import PathLike
from typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:
    viscontact: Any  # type checkers see no cycle: most public classes derive from `Displayable`
else:
    import viscontact


class Displayable:
    """Base class of objects with a display in readable units, in notebooks and when printed."""

    __slots__ = ()

    # Drawings and tables are made by `viscontact.notebook`, a layer above the classes that derive
    # from this one. It is accessed through the package's lazy names, so that it is imported only
    # when an object is displayed; no other module does so. `repr` stays that of the dataclass.
    def _repr_html_(self) -> str:
        return str(viscontact.notebook.display_html(self))

    def __str__(self) -> str:
        return str(viscontact.notebook.display_text(self))


def result_plots(result: object) -> Any:
    """Return the figures of a result, `viscontact.plot.ResultPlots`, imported when first used."""
    return viscontact.plot.ResultPlots(result)


def result_explorer(result: object, **how: Any) -> Any:
    """Return a result to explore, `viscontact.figures.explore`, imported when first used."""
    return viscontact.figures.explore(result, **how)


class Plotted:
    """Base class of objects with a figure of their own."""

    __slots__ = ()

    #: Name of the figure in `viscontact.plot`.
    _figure: ClassVar[str]

    def plot(self, **options: Any) -> Any:
        """Draw its figure.

        Parameters
        ----------
        **options
            Those of the function in `viscontact.plot`, as ``width="single"``.

        Returns
        -------
        matplotlib.figure.Figure
            The figure, which a notebook shows.

        Raises
        ------
        ModuleNotFoundError
            If matplotlib is not installed.
        """
        return getattr(viscontact.plot, self._figure)(self, **options)


class StudyResult(ABC):
    """Result of a study, with a report by `viscontact.report`, imported when first used."""

    def report(self, path: str | PathLike[str]) -> None:
        """Write a page of HTML with figures, tables and notes; some studies make runs for it.

        Parameters
        ----------
        path : path-like
            The page, by custom ending in ``.html``.

        Raises
        ------
        ModuleNotFoundError
            If the packages of figures are not installed.
        OSError
            If the file cannot be written.
        """
        kind, *arguments, options = self._page()
        getattr(viscontact.report, f"write_{kind}_report")(*arguments, path, **options)

    @abstractmethod
    def _page(self) -> tuple[Any, ...]:
        """Kind, arguments before the path, and options of a function ``write_..._report``."""


class DisplayableGroup(Displayable, ABC):
    """Group of objects that are displayed one below the other."""

    __slots__ = ()

    @property
    @abstractmethod
    def display_title(self) -> str:
        """Title of the group."""

    @abstractmethod
    def display_parts(self) -> dict[str, Displayable | str]:
        """Return the objects, and other facts as text, by name."""
