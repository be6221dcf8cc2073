"""Result of a study that is shown on a page of HTML."""

from __future__ import annotations

from abc import ABC, abstractmethod
from os import PathLike
from typing import Any

from viscontact.units.display import write_study_report


class StudyResult(ABC):
    """Result of a study, with a report."""

    def report(self, path: str | PathLike[str]) -> None:
        """Write a page of HTML with figures, tables and notes, which needs nothing from outside.

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

        Notes
        -----
        A design computes the case and the best one once more, in the scenario that decides, and, if
        the load is held and the bodies creep, up to a year.
        """
        kind, *arguments, options = self._page()
        write_study_report(kind, *arguments, path, **options)

    @abstractmethod
    def _page(self) -> tuple[Any, ...]:
        """Kind, arguments before the path, and options of a function ``write_..._report``."""
