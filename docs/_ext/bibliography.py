"""Bibliography of the manual, from the references at the end of its pages."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Mapping
from pathlib import Path

DOCS = Path(__file__).parents[1]

#: Part of a reference that differs between pages.
_PLACE = re.compile(r", (?:sections?|chapters?) [^*]*?(?=\.$)")
_INITIALS = re.compile(r"^(?:[^\W\d_]\. ?)+")


def bibliography() -> str:
    """Return a list of all references with links to the pages that name them, by surname."""
    pages = sorted([*DOCS.glob("theory/*.md"), DOCS / "trust" / "limits.md"])
    texts = {
        f"/{path.relative_to(DOCS).with_suffix('').as_posix()}": path.read_text(encoding="utf-8")
        for path in pages
    }
    return "\n".join(
        f"- {source} {{doc}}`{'`, {doc}`'.join(used)}`" for source, used in collected(texts).items()
    )


def collected(texts: Mapping[str, str]) -> dict[str, list[str]]:
    r"""Return the pages that name each source, sorted by surname and year.

    Parameters
    ----------
    texts : mapping of str to str
        The text of each page.

    Returns
    -------
    dict of str to list of str
        Names of pages by source, without the section of a book.

    Examples
    --------
    >>> johnson = "- K. L. Johnson (1985), *Contact Mechanics*, CUP"
    >>> collected({"b": f"## References\n\n{johnson}, section 5.8.", "a": "## Other\n\n- not"})
    {'K. L. Johnson (1985), *Contact Mechanics*, CUP.': ['b']}
    """
    found: dict[str, list[str]] = {}
    for page, text in texts.items():
        for source in _sources(text):
            found.setdefault(_PLACE.sub("", source), []).append(page)
    return dict(sorted(found.items(), key=lambda item: _order(item[0])))


def _sources(text: str) -> Iterator[str]:
    section = text.partition("## References\n")[2]
    for item in re.split(r"^- ", section.partition("\n## ")[0], flags=re.MULTILINE)[1:]:
        yield " ".join(item.split())


def _order(source: str) -> tuple[str, str]:
    """Surname without accents, and year."""
    plain = unicodedata.normalize("NFKD", _INITIALS.sub("", source)).encode("ascii", "ignore")
    year = re.search(r"\b(1[89]|20)\d\d\b", source)
    return plain.decode().partition(",")[0].partition(" (")[0].lower(), year[0] if year else ""
