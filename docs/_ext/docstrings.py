"""Docstrings as pages: bars such as those of |x| and initials are no reStructuredText."""

from __future__ import annotations

import re
from typing import Any

from sphinx.application import Sphinx
from sphinx.util.typing import ExtensionMetadata

#: At the beginning of a line, or of a reference, where "M. L. Williams" would be item 13 of a list.
_INITIAL = re.compile(r"^(\s*(?:\.\. \[\d+\] )?)([A-Z]\. )")


def as_written(lines: list[str]) -> list[str]:
    r"""Return a docstring whose bars and first initials are escaped, but for those in examples.

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
    >>> as_written(["R for |x| <= L", ">>> 1 | 2", "3", "", "K. L. Johnson"])
    ['R for \\|x\\| <= L', '>>> 1 | 2', '3', '', '\\K. L. Johnson']
    """
    escaped, is_example = [], False
    for line in lines:
        is_example = line.lstrip().startswith(">>>") or (is_example and bool(line.strip()))
        escaped.append(line if is_example else _INITIAL.sub(r"\1\\\2", line.replace("|", r"\|")))
    return escaped


def _escape(
    app: Sphinx, what: str, name: str, documented: Any, options: Any, lines: list[str]
) -> None:
    lines[:] = as_written(lines)


def setup(app: Sphinx) -> ExtensionMetadata:
    """Escape before numpydoc takes docstrings apart."""
    app.connect("autodoc-process-docstring", _escape, priority=100)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
