"""Cards that cannot be read are refused at their line, and any file is a card or an error."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from hypothesis import strategies as st

from bodies.materials.card_texts import ABAQUS, ANSYS, IN_SI, problem, read
from random_examples import given_few_or_many
from returned import some
from viscontact.bodies.materials.cards import read_abaqus, read_ansys, read_cards, read_ls_dyna


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("0.3, 0.,", "0.3, 0.1,", "card.txt:8: the bulk modulus relaxes otherwise than the shear"),
        ("0.3, 0.,", "0.9, 0.,", "card.txt:9: shear terms g: the terms add up to 1.1: more than a"),
        ("0.3, 0.,", "300., 0.,", "term 1 must be a part of the modulus between 0 and 1, got 300."),
        ("0.3, 0.,", "-0.3, 0.,", "must be a part of the modulus between 0 and 1, got -0.3"),
        ("1.D2", "0.", "the relaxation time of term 2 must be positive, got 0.0"),
        ("1.D2", "tau", "card.txt:12: 'tau' is not a number"),
        ("1.D2", "1e999", "card.txt:12: '1e999' is beyond all numbers"),
        ("0.2, , 1.D2", "0.2, 0.2", "card.txt:12: must have 3 numbers, got 2"),
        ("0.2, , 1.D2", "0.7, , 1.D2", None),
        ("time=PRONY", "time=FREQUENCY DATA", "card.txt:10: must have 5 numbers, got 3"),
        ("time=PRONY", "frequency=TABULAR", "FREQUENCY needs long-term moduli, and *ELASTIC has"),
        ("time=PRONY", "time=FREQUENCY DATA, preload=UNIAXIAL", "PRELOAD is not read"),
        ("time=PRONY", "nonlinear", "*VISCOELASTIC, NONLINEAR is not read"),
        ("time=PRONY", "time=PRUNY", "TIME=PRUNY: must be one of PRONY, CREEP TEST DATA"),
        (", time=PRONY", "", "must say TIME=PRONY"),
        ("moduli=INSTANTANEOUS", "moduli=SHORT", "MODULI=SHORT: must be one of LONG TERM, INSTA"),
        ("moduli=INSTANTANEOUS", "type=ORTHO", "TYPE=ORTHO: must be one of ISOTROPIC"),
        ("3000., 0.25", "3000., 0.6", "card.txt:8: Poisson's ratio must lie above -1 and"),
        ("3000., 0.25", "0., 0.2", "card.txt:8: Young's modulus must be positive"),
        ("3000., 0.25", "3000., 0.2, 0.\n2000., 0.2, 50.", "must have one line of E and nu, got 2"),
        ("*Density", "*Elastic\n1, .2\n*Density", "card.txt:9: *ELASTIC occurs twice"),
        ("*elastic, moduli=INSTANTANEOUS\n 3000., 0.25\n", "", "has no *ELASTIC; give E and nu"),
        ("*Step", "*Trs, definition=USER\n*Step", "*TRS, DEFINITION=USER is not read"),
    ],
)  # fmt: skip
def test_abaqus_card_that_cannot_be_read_is_refused_at_its_line(
    old: str, new: str, said: str | None, tmp_path: Path
) -> None:
    assert old in ABAQUS
    text = ABAQUS.replace(old, new, 1)
    if said is None:  # all of the modulus relaxes: a fluid, if the constants are of the instant
        assert read(tmp_path, text).material.law.equilibrium == 0.0
        text = text.replace(", moduli=INSTANTANEOUS", "")
        said = "leave nothing in the long term"
    assert said in problem(tmp_path, text, temperature_unit="K")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("TBDATA,,0.2,100", "TBDATA,,0.2", "TB,PRONY,,,,SHEAR: must have 2 pairs in TBDATA, got 3"),
        ("TBDATA,,0.2,100", "TBDATA,,0.8,100", "the terms add up to 1.1"),
        ("TBDATA,,0.2,100", "TBDATA,,400,100", "cards take relative moduli (G_i/G_0)"),
        ("TBDATA,,0.2,100", "TBDATA,0,0.2,100", "TBDATA begins at a place from 1"),
        ("TBDATA,,0.2,100", "TBDATA,1e99,0.2,100", "TBDATA begins at a place from 1"),
        ("TBDATA,,0.2,100", "TBTEMP,0\nTBTEMP,20\nTBDATA,,0.2,100", "several temperatures"),
        ("SHEAR", "EXPERIMENTAL", "TB,PRONY with the option 'EXPERIMENTAL' is not read"),
        ("SHEAR", "", "TB,PRONY with the option '' is not read; give SHEAR or BULK"),
        ("mp,prxy,1,0.25", "", "material 1 has no MP,PRXY"),
        ("MP,EX,1,3000", "", "material 1 has no MP,EX"),
        ("MP,EX,1,3000", "MP,EX,1,E0", "card.txt:3: 'E0' is not a number"),
        ("MP,EX,1,3000", "MP,EX,1,3000,-2", "MP,EX depends on temperature"),
        ("MP,EX,1,3000", "MP,EX,1,3000\nMP,NUXY,1,.3", "PRXY and NUXY of an isotropic material"),
        ("MP,EX,1,3000", "MPTEMP,1,0,9\nMPDATA,EX,1,1,3,2", "MPDATA,EX depends on temperature"),
        ("MP,EX,1,3000", "MPDATA,EX,1,1,3\nMPDATA,EX,1,2,2", "MPDATA,EX depends on temperature"),
        ("MP,EX,1,3000", "MPDATA,EX,1", "MPDATA,EX has no value; give a constant with MP,EX"),
        ("MP,EX,1,3000", "MP,EX,1,3000\nTBCOPY,ALL,2,1", "TBCOPY is not read"),
        ("TBDATA,1,0.3", "TBFIELD,FREQ,1\nTBDATA,1,0.3", "TBFIELD,FREQ is not read"),
        ("TBDATA,1,0.3", "TBPT,DEFI,1,2\nTBDATA,1,0.3", "points (TBPT) are not read"),
        ("TBDATA,1,0.3,10\nTBDATA,,0.2,100\n", "", "TB,PRONY,,,,SHEAR: has no TBDATA"),
        ("TB,PRONY", "TBDELE,ALL,1\nTB,PRONY", None),
        ("TBDATA,,0.2,100\n", "TBDATA,,0.2,100\nTB,SHIFT,1,,,WLF\nTBDELE,PRON,1\n", "needs TB,PR"),
        ("MP,EX,1,3000", "MP,EX,1.5,3000", "a material's number is whole and positive"),
        ("TB,PRONY", "TB,SHIFT,1,,,USER\nTB,PRONY", "TB,SHIFT with 'USER' is not read"),
        ("TB,PRONY", "TB,SHIFT,1,,,WLF\nTBDATA,1,1,2,3,4\nTB,PRONY", "has more than 3 values"),
        ("TB,PRONY", "TB,PRONY,1,,2,SHEAR\nTBDATA,1,1\nTB,PRONY", "occurs twice"),
        ("TB,PRONY", "TB,ELASTIC,1,,,ORTE\nTB,PRONY", "TB,ELASTIC must be ISOT"),
    ],
)  # fmt: skip
def test_ansys_card_that_cannot_be_read_is_refused_at_its_line(
    old: str, new: str, said: str | None, tmp_path: Path
) -> None:
    assert old in ANSYS
    if said is None:
        assert read(tmp_path, ANSYS.replace(old, new, 1)) == read(tmp_path, ANSYS)
        return
    assert said in problem(tmp_path, ANSYS.replace(old, new, 1), temperature_unit="K")


def test_file_of_neither_program_is_refused(tmp_path: Path) -> None:
    assert "is no card of a program that is read" in problem(tmp_path, "time [s], E [MPa]\n1, 2\n")
    both = problem(tmp_path, ABAQUS + ANSYS)
    assert "has commands of Abaqus (*ELASTIC, *VISCOELASTIC) and of Ansys (MP,EX and TB" in both
    for reader in (read_abaqus, read_ansys):
        with pytest.raises(ValueError, match="is it an"):
            read(tmp_path, "", reader)
        with pytest.raises(ValueError, match="cannot read 'm' as a pressure"):
            read(tmp_path, ABAQUS, reader, modulus_unit="m")


PIECES = st.sampled_from(
    ["*Material, name=A\n", "*Elastic\n", "*Viscoelastic, time=PRONY\n", "3., 0.3\n", "0.5,0.,1.\n",
     "*Trs\n", "*Shear Test Data, shrinf=.5\n", "time=RELAXATION TEST DATA", ",", "\n", "1e400",
     '"', "MP,EX,1,3\n", "MP,PRXY,1,.3\n", "TB,PRONY,1,1,1,SHEAR\n", "TBDATA,1,.5,1\n", "TBDATA,",
     "*MAT_006\n", "*mat_76_TITLE\n", "1,,2.,3.,1.,.5\n", "3.         2.\n", "*PARAMETER\nRa,1\n",
     "MPDATA,R5.0,1,EX,1,1,3\n", "TBDELE,ALL,ALL\n", "*Viscoel, freq=TABULAR\n", "&a", "*Creep\n",
     "$", "TB,SHIFT,1,,,WLF\n", "=", "*", "!", "-1", "TBTEMP,", "x", "0.5, 1.\n", "*Step\n"]
)  # fmt: skip
CARDS = (
    [
        "*Material, name=A\n",
        "*Elastic\n",
        "3., 0.3\n",
        "*Viscoelastic, time=PRONY\n",
        "0.5,0.,1.\n",
    ],
    ["MP,EX,1,3\n", "MP,PRXY,1,.3\n", "TB,PRONY,1,1,1,SHEAR\n", "TBDATA,1,.5,1\n"],
    ["*MAT_076\n", "1,,3.\n", "\n", "2.,1.\n", "1.,0.\n"],
)


def _damaged(card: list[str], at: int, piece: str) -> str:
    return "".join([*card[:at], piece, *card[at:]])


#: Cards with a piece put in somewhere: by chance alone none of a hundred files is a card.
DAMAGED = st.builds(_damaged, st.sampled_from(CARDS), st.integers(0, 5), PIECES)


@given_few_or_many(
    25, 300, st.lists(PIECES, max_size=14).map("".join) | DAMAGED | st.text(max_size=30)
)
def test_any_file_is_a_card_or_a_value_error(
    tmp_path_factory: pytest.TempPathFactory, text: str
) -> None:
    path = tmp_path_factory.getbasetemp() / "any.txt"
    path.write_bytes(text.encode("utf-8", "surrogatepass"))
    for reader in (read_abaqus, read_ansys, read_ls_dyna, read_cards):
        with suppress(ValueError):
            for card in some(reader(path, **IN_SI, temperature_unit="K")):
                assert np.isfinite(card.material.law(1.0))
