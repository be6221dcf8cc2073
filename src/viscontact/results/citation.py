"""Citation of the program and of the paper it is based on, as in CITATION.cff."""

from __future__ import annotations

#: Citation of the program.
_PROGRAM = (
    "The viscontact developers: viscontact: contact of creeping bodies. Version {version}, MIT."
)
#: The paper on which it is based.
_PAPER = (
    "Spinu, S.; Cerlinca, D.: Viscoelastic contact modelling: application to the finite length "
    "line contact. 2018."
)
_BIBTEX = """\
@software{{viscontact,
  author  = {{{{The viscontact developers}}}},
  title   = {{viscontact: contact of creeping bodies}},
  version = {{{version}}},
  license = {{MIT}}
}}

@article{{SpinuCerlinca2018,
  author = {{Spinu, S. and Cerlinca, D.}},
  title  = {{Viscoelastic contact modelling: application to the finite length line contact}},
  year   = {{2018}}
}}"""


def citations(version: str) -> tuple[str, str]:
    """Return the citations of a version of the program and of the paper, as sentences."""
    return _PROGRAM.format(version=version), _PAPER


def bibtex(version: str) -> str:
    """Return both citations as BibTeX."""
    return _BIBTEX.format(version=version)
