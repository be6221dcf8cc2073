"""Equations as MathML, which browsers draw themselves: no script, no font, no network."""

from __future__ import annotations

import re

from docutils import nodes
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError
from sphinx.util.math import get_node_equation_number
from sphinx.util.typing import ExtensionMetadata
from sphinx.writers.html5 import HTML5Translator

#: What LaTeX takes for a half, and the converter for something else, silently.
_BARE = re.compile(r"\\[td]?frac\s*[^{\s]|\\[td]frac")

#: A function's name before what it is of, if that has no brackets: they stand a little apart.
_APPLIED = re.compile(
    r"(\\(?:ln|log|exp|sin|cos|cot|arctan|operatorname\{\w+\})(?:[\^_](?:\w|\{\w+\}))?)\s+(?=[^\s({,])"
)

#: Signs as mathematics writes them.
_SIGNS = {"<mo>'</mo>": '<mo lspace="0em" rspace="0em">′</mo>', "<mo>*</mo>": "<mo>∗</mo>"}


def mathml(tex: str, as_block: bool = False) -> str:
    """Return an equation in MathML.

    Parameters
    ----------
    tex : str
        The equation in LaTeX.
    as_block : bool
        Whether it stands on a line of its own.

    Returns
    -------
    str
        The element ``<math>``.

    Raises
    ------
    ExtensionError
        If the equation uses what the converter does not know.

    Examples
    --------
    >>> mathml("t'").count("′")
    1
    """
    bare = _BARE.search(tex)
    if bare:
        raise ExtensionError(f"in the equation {tex!r}: write \\frac{{a}}{{b}}, not {bare[0]!r}")
    try:
        written = tex2mathml(_APPLIED.sub(r"\1\\,", tex), as_block=as_block)
    except MathError as error:
        raise ExtensionError(f"cannot write the equation {tex!r} in MathML: {error}") from error
    for plain, sign in _SIGNS.items():
        written = written.replace(plain, sign)
    return str(written)


def _inline(self: HTML5Translator, node: nodes.math) -> None:
    self.body.append(mathml(node.astext()))
    raise nodes.SkipNode


def _displayed(self: HTML5Translator, node: nodes.math_block) -> None:
    self.body.append(self.starttag(node, "div", CLASS="equation"))
    self.body.append(mathml(node.astext(), as_block=True))
    if node["number"]:
        self.body.append(f'<span class="eqno">({get_node_equation_number(self, node)})')
        self.add_permalink_ref(node, "Link to this equation")
        self.body.append("</span>")
    self.body.append("</div>\n")
    raise nodes.SkipNode


def setup(app: Sphinx) -> ExtensionMetadata:
    """Enter the renderer, to be chosen by ``html_math_renderer = "mathml"``."""
    app.add_html_math_renderer("mathml", (_inline, None), (_displayed, None))
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
