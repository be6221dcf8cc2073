"""Programs whose input files are recognised and not read."""

from __future__ import annotations

import re

from viscontact.backend.lazy_dataclass import dataclass


@dataclass(frozen=True)
class Program:
    """A program, and a pattern that only its files have."""

    name: str
    pattern: re.Pattern[str]

    def refusal(self, source: str) -> str:
        """Return the message for a file of this name."""
        return (
            f"{source}: is an input file of {self.name}, which is not read; give its constants in "
            "a case file (law: relaxation-series with equilibrium, moduli and times, or law: "
            "elastic), or as a card of Abaqus, Ansys or LS-DYNA"
        )


def _lines(pattern: str) -> re.Pattern[str]:
    """Pattern at the beginning of a line."""
    return re.compile(rf"^[ \t]*(?:{pattern})", re.I | re.M)


_NASTRAN = r"(?:MAT(?:\d{1,2}|S1|VE|FVE|TVE|VP|HE|HP|HEV|G|EP|PE1|F\d?)|MVISCO|TABVE)"

#: Programs in the order in which they are tried.
PROGRAMS = (
    Program("Radioss", _lines(r"#RADIOSS\b|/(?:MAT|VISC|UNIT|FUNCT)/\w+")),
    Program("PERMAS", _lines(r"\$(?:ENTER|EXIT)\s+(?:MATERIAL|COMPONENT)|\$MATERIAL\s+NAME")),
    Program("FrontISTR", _lines(r"!(?:MATERIAL|VISCOELASTIC|ELASTIC)\b\s*(?:,|$)")),
    Program("Marc", _lines(r"viscel(?:prop|moon|ogden|orth|foam)\b")),
    Program("Nastran", _lines(rf"BEGIN[ \t]+BULK|{_NASTRAN}\*?[ \t,]+\d")),
    Program("PAM-CRASH", _lines(r"MATER[ \t]*/")),
    Program("ADINA", _lines(r"MATERIAL[ \t]+(?:VISCO-?ELASTIC|ELASTIC|CREEP)[ \t]+NAME=")),
    Program("code_aster", re.compile(r"\bDEFI_MATERIAU\s*\(")),
    Program("Abaqus/CAE (a script)", re.compile(r"\bmdb\.models\[|\.Viscoelastic\(\s*domain=")),
    Program("FEBio", re.compile(r"<febio_spec\b", re.I)),
    Program("Ansys Workbench (Engineering Data)", re.compile(r"<(?:EngineeringData|MatML_Doc)\b")),
    Program("SolidWorks", re.compile(r"<\w*:?materials\b[^>]*solidworks", re.I)),
    Program("COMSOL", re.compile(r"<archive\b|\bcom\.comsol\b|<material\b[^>]*\bmatType=", re.I)),
    Program("a program that writes XML", re.compile(r"\A\s*<\?xml\b")),
)


def program_of(text: str) -> Program | None:
    """Return the program that a text is recognised as an input file of; None if none."""
    return next((each for each in PROGRAMS if each.pattern.search(text)), None)
