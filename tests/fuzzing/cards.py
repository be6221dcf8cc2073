"""Material cards: good ones, of Abaqus and Ansys by our own writers, and what becomes of them."""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st

import viscontact as vc
from fuzzing import junk
from fuzzing.damage import damaged
from viscontact.bodies.materials.cards import Card, write_abaqus, write_ansys
from viscontact.laws import WLF

_UNITS = {"modulus_unit": "MPa", "time_unit": "s", "temperature_unit": "degC"}
_SERIES = Card(
    "polymer",
    vc.Material(vc.RelaxationSeries(1e6, [2e6, 3e6], [0.1, 10.0]), bulk_modulus=4e9),
    WLF(298.15, 17.44, 51.6),
)
_RUBBER = Card("1", vc.Material(vc.RelaxationSeries(1e6, [1e6], [10.0]), 0.49))
_TABLE = Card("t", vc.Material(vc.TabulatedRelaxation([0.0, 1.0, 10.0], [3e6, 2e6, 1e6]), 0.3))

CARDS = {
    "card.inp": write_abaqus(_SERIES, **_UNITS),
    "test.inp": write_abaqus(_TABLE, modulus_unit="MPa", time_unit="s"),
    "two.inp": "".join(write_abaqus(card, **_UNITS) for card in (_SERIES, _RUBBER)),
    "card.mac": write_ansys(_RUBBER, **_UNITS),
    "frequency.inp": "*MATERIAL, NAME=PAD\n*ELASTIC\n10., 0.49\n*VISCOELASTIC, FREQUENCY=TABULAR\n"
    "0.3, -0.1, 0., 0., 0.01\n0.5, -0.4, 0., 0., 0.1\n0.3, -0.9, 0., 0., 1.\n",
    "formula.inp": "*ELASTIC\n10., 0.49\n*VISCOELASTIC, FREQUENCY=FORMULA\n0.05, -0.05, 0.5\n",
    "arrhenius.inp": "*PHYSICAL CONSTANTS, UNIVERSAL GAS=8.3, ABSOLUTE ZERO=-273.15\n"
    "*MATERIAL, NAME=A\n*ELASTIC\n2e3, 0.35\n*VISCOELASTIC, FREQ=PRONY\n0.3, 0., 0.1\n"
    "*TRS, DEF=ARRHENIUS\n20., 8e4\n",
    "library.mpl": "/COM,ANSYS\nTBDEL,ALL,_MATL\nMPTEMP,R5.0, 1, 1,  0.0    ,\n"
    "MPDATA,R5.0, 1,EX  ,_MATL , 1,  1000.0    ,\nMPDATA,R5.0, 1,PRXY,_MATL , 1, 0.45 ,\n"
    "TB,PRON,_MATL   ,   1,   2,SHEA\nTBFIELD,Temps,0.0\nTBDATA,1,3.0e-01,1.0e-01,2.0e-01\n"
    "TBDATA,4,1.0\n",
    "six.k": "*KEYWORD\n*MAT_VISCOELASTIC\n$#     mid\n         1  1.05E-09    2000.0     330.0"
    "      80.0       1.0\n*END\n",
    "many.k": "*PARAMETER\nR       g1     150.0\n*MAT_GENERAL_VISCOELASTIC_TITLE\nrubber\n"
    "         1  1.05E-09    2000.0\n\n       &g1      10.0\n     100.0       1.0\n      80.0\n",
}

_LINES = (
    *("*MATERIAL, NAME=x", "*MATERIAL", "*ELASTIC, MODULI=LONG TERM", "*ELASTIC, TYPE=ORTHO"),
    *("*VISCOELASTIC, TIME=PRONY", "*VISCOELASTIC, TIME=CREEP TEST DATA", "*VISCOELASTIC"),
    *("*VISCOELASTIC, FREQUENCY=FORMULA", "*VISCOELASTIC, TIME=FREQUENCY DATA", "*HYPERELASTIC"),
    *("*SHEAR TEST DATA, SHRINF=0.5", "*VOLUMETRIC TEST DATA", "*COMBINED TEST DATA", "*TRS"),
    *(
        "*TRS, DEFINITION=USER",
        "*INCLUDE, INPUT=/etc/passwd",
        "*INCLUDE, INPUT=card.inp",
        "0.5, 0.0",
    ),
    *(
        "MP,EX,1,6",
        "MP,PRXY,1,0.5",
        "MP,EX,0,6",
        "MP,EX,1e9,6",
        "MP",
        "MP,EX,1,6,1",
        "TB",
        "TBDATA",
    ),
    *("TB,PRONY,1,1,1,SHEAR", "TB,PRONY,1,1,1e9,BULK", "TB,SHIFT,1,1,3,WLF", "TB,SHIFT,1,1,2,TN"),
    *(
        "TBDATA,1,0.5,10",
        "TBDATA,1000,1,2,3",
        "TBDATA,1e9,1",
        "TBDATA,-1,1",
        "TBTEMP,1",
        "/INPUT,x",
    ),
    *(
        "*DO,I,1,1e9",
        "*SET,A,1",
        "A=B",
        "B=A",
        "A=A+1",
        "MP,EX,A,A",
        "TBDATA,1,A,A",
        "! why",
        "$" * 99,
    ),
    *(
        "*CREEP",
        "*VISC",
        "*",
        "*VISCOUS, LAW=TIME",
        "*HYSTERESIS",
        "*VISCOELASTIC, FREQUENCY=FORMULA",
        "0.1, -0.2, 0., 0., 1e300",
    ),
    *("TB,CREEP,1", "TB,PRON,1,,,INTE", "TBFIELD,FREQ,1", "MPDATA,R5.0,9,EX,1,1,1,2,3", "MPDATA"),
    *("MPTEMP", "TBDELE,ALL,ALL", "TBCOPY,ALL,1,2", "MPDELE,EX,_MATL", "MP,VISC,1,1", "TBPT,,1,2"),
    *("*MAT_006", "*mat_76_title", "*MAT_ELASTIC+", "*MAT_RIGID", "*MAT_ADD_INELASTICITY", "*MAT_"),
    *("*PARAMETER", "*PARAMETER_EXPRESSION", "*KEYWORD LONG=Y", "&g1", "       401", "\t1\t2"),
    *(
        "BEGIN BULK",
        "/MAT/LAW34/1",
        "$ENTER MATERIAL",
        "<?xml version='1.0'?>",
        "!MATERIAL, NAME=x",
    ),
    *("," * 5000, "*ELASTIC" + "," * 5000, '*MATERIAL, NAME="' + '"a,' * 2000, "*" * 3000),
)


def cards() -> st.SearchStrategy[tuple[str, bytes]]:
    """Return the name of the card that it began as, and the bytes that it became."""
    return st.sampled_from(sorted(CARDS)).flatmap(
        lambda name: st.tuples(st.just(name), _changed(CARDS[name]))
    )


@st.composite
def _changed(draw: Any, text: str) -> bytes:
    lines = text.splitlines()
    for _ in range(draw(st.integers(0, 3))):
        place = draw(st.integers(0, len(lines)))
        what = draw(st.sampled_from(("line", "field", "field", "field", "drop", "double")))
        if what == "line":
            lines.insert(place, draw(junk.one_of(_LINES)))
        elif what == "drop":
            del lines[place : place + 1]
        elif what == "double":
            lines[place:place] = lines[place : place + 2]
        elif place < len(lines):
            fields = lines[place].split(",")
            fields[draw(st.integers(0, len(fields) - 1))] = draw(
                st.one_of(junk.number_texts(), junk.texts())
            )
            lines[place] = ",".join(fields)
    joined = draw(st.sampled_from(("\n", "\n", "\n", "\r\n", "\r")))
    return draw(damaged(joined.join(lines) + joined))
