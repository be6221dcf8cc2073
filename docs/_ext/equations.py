"""Equations as MathML, which browsers render without scripts, fonts or network."""

from __future__ import annotations

import itertools
import re

from docutils import nodes
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError
from sphinx.util.math import get_node_equation_number
from sphinx.util.typing import ExtensionMetadata
from sphinx.writers.html5 import HTML5Translator

#: LaTeX that the converter renders wrongly without an error, and its replacement.
_MISREAD = {
    r"\\[td]?frac\s*[^{\s]|\\[td]frac": r"\frac{a}{b}",
    r"\\(?:d?dot|bar|hat|tilde|vec)\s*(?:\w|\\\w+|\{[^}]*\})\s*[_^]": r"{\bar a}_b",
    r"\\underbrace": "words",
}

#: A function name needs a small space after a factor, and before an argument without brackets.
_NAME = r"\\(?:ln|log|exp|sin|cos|cot|arctan|operatorname\{\w+\})"
_MULTIPLIED = re.compile(rf"(?<=[\w}}*])\s*(?={_NAME}(?![a-z]))")
_APPLIED = re.compile(rf"({_NAME}(?:[\^_](?:\w|\{{\w+\}}))?)\s+(?=[^\s({{,])")

#: Symbols with mathematical typography.
_SIGNS = {
    "<mo>'</mo>": '<mo lspace="0em" rspace="0em">′</mo>',
    "<mo>*</mo>": "<mo>∗</mo>",
    '<mo stretchy="false">/</mo>': '<mo stretchy="false" lspace="0.06em" rspace="0.06em">/</mo>',
}

#: Bars come in pairs; browsers do not know which one opens.
_BAR = re.compile(r"<mo[^>]*>\|</mo>")


def mathml(tex: str, as_block: bool = False) -> str:
    """Return an equation in MathML.

    Parameters
    ----------
    tex : str
        The equation in LaTeX.
    as_block : bool
        Whether it is a displayed equation.

    Returns
    -------
    str
        The element ``<math>``.

    Raises
    ------
    ExtensionError
        If the converter does not support a part of the equation.

    Examples
    --------
    >>> mathml("t'").count("′")
    1
    """
    for misread, remedy in _MISREAD.items():
        if found := re.search(misread, tex):
            raise ExtensionError(f"in the equation {tex!r}: write {remedy}, not {found[0]!r}")
    try:
        spaced = _APPLIED.sub(r"\1\\,", _MULTIPLIED.sub(r"\\,", tex))
        written = tex2mathml(spaced, as_block=as_block)
    except MathError as error:
        raise ExtensionError(f"cannot write the equation {tex!r} in MathML: {error}") from error
    for plain, sign in _SIGNS.items():
        written = written.replace(plain, sign)
    forms = itertools.cycle(("prefix", "postfix"))
    return _BAR.sub(lambda _: _bar(next(forms)), written)


def _bar(form: str) -> str:
    return f'<mo form="{form}" stretchy="false" lspace="0em" rspace="0em">|</mo>'


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
    """Register the renderer, selected by ``html_math_renderer = "mathml"``."""
    app.add_html_math_renderer("mathml", (_inline, None), (_displayed, None))
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
