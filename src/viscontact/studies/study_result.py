"""Result of a study that is shown on a page of HTML, and the error of one without a result."""

from __future__ import annotations

from abc import ABC, abstractmethod
from os import PathLike
from typing import Any

from viscontact.units.display import write_study_report


class InfeasibleError(ValueError):
    """A study has no result: none of its runs keeps what is requested."""


class StudyResult(ABC):
    """Result of a study, with a report."""

    def report(self, path: str | PathLike[str]) -> None:
        """Write a page of HTML with figures, tables and notes; some of its runs are made for it.

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
        write_study_report(kind, *arguments, path, **options)

    @abstractmethod
    def _page(self) -> tuple[Any, ...]:
        """Kind, arguments before the path, and options of a function ``write_..._report``."""
