"""Texts with colours and tables on a terminal, where the texts of users are printed as they are."""

from __future__ import annotations

from typing import Any

from rich.console import Console
from rich.text import Text

from viscontact.units.visible import visible


class TextConsole(Console):
    """Console in whose texts nothing is markup, a sign's name or a control character."""

    def __init__(self, *, stderr: bool = False, width: int | None = None) -> None:
        super().__init__(stderr=stderr, width=width, markup=False, emoji=False)

    def render_str(self, text: str, **how: Any) -> Text:
        """Make the text that is printed; tables and bars call it for theirs, too."""
        return super().render_str(visible(text), **how)

    def warn(self, line: str, **how: Any) -> None:
        """Print a warning."""
        self.print(styled("warning:", "yellow"), line, **how)


def styled(text: str, style: str = "") -> Text:
    """Text in a colour."""
    return Text(visible(text), style)
