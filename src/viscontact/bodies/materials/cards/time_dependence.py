"""Keywords of cards whose names state a dependence on time or rate, and why each is not read.

A card with one of them is refused: as an elastic one it would be another material. What is read
(``*VISCOELASTIC``, ``TB,PRONY``, ...) is not among them. Lists: Abaqus 2016 Keywords Reference
Guide, the options of the material definition; Mechanical APDL Command Reference, TB, MP and TBFIELD
(releases 14 to 24, and the archived labels of explicit dynamics); LS-DYNA Keyword User's Manual,
volume II.
"""

from __future__ import annotations

import re

_NETWORK = "a nonlinear network, while the contact is linear viscoelastic"
_CREEP = "creep that is not linear in the stress"
_PLASTIC_RATE = "rate-dependent plasticity"
_VISCOSITY = "a viscosity"
_NOT_LINEAR = "no linear viscoelastic law"

#: Keywords of Abaqus and what they define.
ABAQUS = {
    "CAP CREEP": _CREEP,
    "CREEP": _CREEP,
    "CREEP STRAIN RATE CONTROL": _CREEP,
    "DRUCKER PRAGER CREEP": _CREEP,
    "HYSTERESIS": _NETWORK,
    "LOW DENSITY FOAM": "a rate-dependent foam",
    "NONLINEAR VISCOELASTIC": _NETWORK,
    "PARALLEL NETWORK": _NETWORK,
    "RATE DEPENDENT": _PLASTIC_RATE,
    "SWELLING": "a swelling over time",
    "VISCOSITY": "a viscosity of a fluid",
    "VISCOUS": _CREEP,
}
#: Parameters of Abaqus by keyword.
ABAQUS_PARAMETERS = {"PLASTIC": ("RATE",), "CAST IRON PLASTICITY": ("RATE",)}

#: First four letters of labels of TB, and what the tables define.
ANSYS_TABLES = {
    "ANAN": _PLASTIC_RATE,
    "AVIS": _VISCOSITY,
    "BB": _NETWORK,
    "CREE": _CREEP,
    "EVIS": "an older form of viscoelasticity, for explicit dynamics",
    "FICT": "a fictive temperature that relaxes",
    "HYST": _NETWORK,
    "PERI": _PLASTIC_RATE,
    "PERZ": _PLASTIC_RATE,
    "RATE": _PLASTIC_RATE,
    "SINT": "a sintering over time",
    "SWEL": "a swelling over time",
    "VISC": _VISCOSITY,
}
#: Options of tables that are otherwise of no effect here, by first four letters.
ANSYS_OPTIONS = {"EXPE": ("CREE", "GMOD", "KMOD", "EMOD", "SMOD", "BMOD")}
#: Labels of MP.
ANSYS_PROPERTIES = {"BVIS": _VISCOSITY, "VISC": _VISCOSITY}

#: Words in the names of keywords *MAT_ADD_... of LS-DYNA, which extend another material.
LS_DYNA_ADDED = ("INELASTICITY", "PROPERTY_DEPENDENCE", "VISCO", "CREEP", "RATE")

# Beginnings of words in keywords that are in no list, such as misspelt or later ones.
_STEM = re.compile(r"\b(?:visc|creep|relax|retard|hyster|rate|prony|swell|maxwell|kelvin)", re.I)


def states_time(words: str) -> bool:
    """Return whether an unknown keyword has a word that begins as one of time or rate does."""
    return _STEM.search(words) is not None


def refusal(where: str, keyword: str, what: str = _NOT_LINEAR) -> str:
    """Return the message of a keyword, as it is written, with which a card is refused."""
    return (
        f"{where}: {keyword} is not read: it defines {what}; without it the material would be "
        "another one. Remove it if that is what you want, or give a linear viscoelastic law in "
        "its place, such as a Prony series"
    )
