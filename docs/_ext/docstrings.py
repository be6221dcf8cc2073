"""Docstrings as pages: bars such as those of |x| are bars, not reStructuredText."""

from __future__ import annotations

from typing import Any

from sphinx.application import Sphinx
from sphinx.util.typing import ExtensionMetadata


def with_bars(lines: list[str]) -> list[str]:
    r"""Return a docstring whose bars are escaped, but for those in examples.

    Parameters
    ----------
    lines : list of str
        The docstring.

    Returns
    -------
    list of str
        As many lines.

    Examples
    --------
    >>> with_bars(["R for |x| <= L", ">>> 1 | 2", "3"])
    ['R for \\|x\\| <= L', '>>> 1 | 2', '3']
    """
    escaped, is_example = [], False
    for line in lines:
        is_example = line.lstrip().startswith(">>>") or (is_example and bool(line.strip()))
        escaped.append(line if is_example else line.replace("|", r"\|"))
    return escaped


def _escape(
    app: Sphinx, what: str, name: str, documented: Any, options: Any, lines: list[str]
) -> None:
    lines[:] = with_bars(lines)


def setup(app: Sphinx) -> ExtensionMetadata:
    """Escape before numpydoc takes docstrings apart."""
    app.connect("autodoc-process-docstring", _escape, priority=100)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
