"""Line breaks in pages.

Browsers break a line after any hyphen and next to any inline element, but not within a long name.
This extension keeps a number and its unit together, an equation or inline code and the punctuation
around it, and words with hyphens in commands. It allows breaks in a long name after underscores,
slashes and dots.
"""

from __future__ import annotations

import re
from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.transforms.post_transforms import SphinxPostTransform
from sphinx.util.typing import ExtensionMetadata

_UNIT = (
    r"%|°C|[kmµn]?N|[kMG]?Pa|[mµn]?m[²³]?|[mµn]?s|min|h|[mµ]?rad|[kMG]?Hz|[mµna]?J|[kMG]B|px|\d{3}"
)
_QUANTITY = re.compile(rf"(?<=\d) (?=(?:{_UNIT})(?!\w))")

_BLOCK = re.compile(  # inline equations and code, next to which browsers may break
    r"""(\(?)(?:<math\b(?![^>]*\bdisplay=)(?:(?!</math>).)*</math>|<code\b(?:(?!</code>).)*</code>)
        ([).,;:!?’]*)""",
    re.DOTALL | re.VERBOSE,
)
_COMMANDS = re.compile(
    r'(?<=<div class="highlight-sh notranslate"><div class="highlight"><pre>).*?(?=</pre>)',
    re.DOTALL,
)
_WORD = re.compile(r"(?<=[>\s])[^<>\s]*[-/][^<>\s]*(?=[<\s])")
_LITERAL = re.compile(r"<code\b.*?</code>", re.DOTALL)
_LONG_NAME = re.compile(r'(?<=<span class="pre">)[^<]{25,}(?=</span>)')
_JOINT = re.compile(r"(::|[_/=]+|\.(?=\w{4}))(?=\w)")

#: Nodes in which spaces must not change.
_UNCHANGED = (
    *(nodes.literal, nodes.FixedTextElement, nodes.math, nodes.math_block, nodes.raw),
    addnodes.desc_signature,
)


def keeping_units(text: str) -> str:
    r"""Return a text without line breaks between a number and its unit, or within a number.

    Parameters
    ----------
    text : str
        Text of a page.

    Returns
    -------
    str
        The same text with no-break spaces.

    Examples
    --------
    >>> keeping_units("10 kN for 240 s, 26 675 times").count("\N{NO-BREAK SPACE}")
    3
    """
    return _QUANTITY.sub("\N{NO-BREAK SPACE}", text)


def breaking_well(html: str) -> str:
    """Return a page with suitable line breaks in equations, commands and long names.

    Parameters
    ----------
    html : str
        The page.

    Returns
    -------
    str
        The same page, with spans of the class ``whole`` and ``<wbr>`` elements.

    Examples
    --------
    >>> breaking_well("<p>of <math>t</math>, then")
    '<p>of <span class="whole"><math>t</math>,</span> then'
    """
    html = _BLOCK.sub(_with_its_marks, html)
    html = _COMMANDS.sub(lambda box: _WORD.sub(_whole, box[0]), html)
    return _LITERAL.sub(lambda code: _LONG_NAME.sub(_jointed, code[0]), html)


def _with_its_marks(found: re.Match[str]) -> str:
    return _whole(found) if found[1] or found[2] else found[0]


def _whole(found: re.Match[str]) -> str:
    return f'<span class="whole">{found[0]}</span>'


def _jointed(name: re.Match[str]) -> str:
    return _JOINT.sub(r"\1<wbr>", name[0])


class _Units(SphinxPostTransform):
    """Joins numbers and units, after all other transforms."""

    default_priority = 900

    def run(self, **_: Any) -> None:
        for text in list(self.document.findall(nodes.Text)):
            above = text.parent
            while above is not None and not isinstance(above, _UNCHANGED):
                above = above.parent
            kept = keeping_units(str(text))
            if above is None and kept != text:
                text.parent.replace(text, nodes.Text(kept))


def _page(
    app: Sphinx, page: str, template: str, context: dict[str, Any], tree: nodes.document | None
) -> None:
    if "body" in context:
        context["body"] = breaking_well(context["body"])


def setup(app: Sphinx) -> ExtensionMetadata:
    """Connect the line-break rules to every page."""
    app.add_post_transform(_Units)
    app.connect("html-page-context", _page)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
