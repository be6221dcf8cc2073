"""Check that the manual makes no network requests."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from sphinx.application import Sphinx
from sphinx.errors import ExtensionError
from sphinx.util.typing import ExtensionMetadata

#: Resources that a browser loads automatically, in contrast to links.
_LOADED = re.compile(
    r"""<(?:script|img|iframe|source|video|audio|embed|object)\b[^>]*?\b(?:src|data)=["']?
        (?:https?:)?//[^"'\s>]+
      | <link\b(?![^>]*\brel=["']?canonical)[^>]*?\bhref=["']?(?:https?:)?//[^"'\s>]+
      | @import\s+["']?(?:url\()?["']?(?:https?:)?//[^"'\s)]+
      | \burl\(\s*["']?(?:https?:)?//[^"'\s)]+""",
    re.VERBOSE | re.IGNORECASE,
)


def loaded_from_outside(text: str) -> list[str]:
    """Return the references by which a page or a style sheet loads from the network.

    Parameters
    ----------
    text : str
        HTML or CSS.

    Returns
    -------
    list of str
        The references as in the text.

    Examples
    --------
    >>> loaded_from_outside('<script src="https://example.org/a.js"></script><a href="https://b">')
    ['<script src="https://example.org/a.js']
    """
    return [found[0] for found in _LOADED.finditer(text)]


def _refuse(app: Sphinx, error: Exception | None) -> None:
    if error is not None:
        return
    found = list(_findings(Path(app.outdir)))
    if found:
        raise ExtensionError("the manual would load from the network:\n" + "\n".join(found))


def _findings(folder: Path) -> Iterator[str]:
    for path in sorted(folder.rglob("*")):
        if path.suffix in (".html", ".css"):
            for place in loaded_from_outside(path.read_text(encoding="utf-8", errors="replace")):
                yield f"{path.relative_to(folder)}: {place[:100]}"


def setup(app: Sphinx) -> ExtensionMetadata:
    """Check all pages after the build."""
    app.connect("build-finished", _refuse)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
