"""Input files of programs that are not read are recognised, and tables are not."""

from __future__ import annotations

from pathlib import Path

import pytest

from viscontact.bodies.materials.cards import is_card, read_card
from viscontact.bodies.materials.cards.other_programs import PROGRAMS, program_of

FILES = {
    "Radioss": "#RADIOSS STARTER\n/BEGIN\ncard\n/MAT/LAW34/1\nrubber\n",
    "PERMAS": "$ENTER MATERIAL\n  $MATERIAL NAME = STEEL TYPE = ISO\n    $ELASTIC\n  2e5 .3\n",
    "FrontISTR": "!MATERIAL, NAME=R\n!ELASTIC\n 3., 0.4\n!VISCOELASTIC\n 0.5, 1.\n",
    "Marc": "isotropic\n\n1,elastic ,isotropic ,10\nviscelprop\n\n1,0,0,1,0\n",
    "Nastran": "SOL 101\nCEND\nBEGIN BULK\nMAT1           1    10.0            0.45\n",
    "PAM-CRASH": "$ card\nMATER /        1       5  1.2E-6\n",
    "ADINA": "MATERIAL ELASTIC NAME=1 E=2.07E11 NU=0.3\n",
    "code_aster": "MAT = DEFI_MATERIAU(ELAS=_F(E=2.1e11, NU=0.3))\n",
    "Abaqus/CAE (a script)": "mdb.models['M'].Material('R')\n",
    "FEBio": "<?xml version='1.0'?>\n<febio_spec version='4.0'>\n",
    "Ansys Workbench (Engineering Data)": "<?xml version='1.0'?>\n<EngineeringData version='18'>\n",
    "SolidWorks": "<?xml version='1.0'?>\n<mstns:materials xmlns:mstns='http://www.solidworks.com'>\n",
    "COMSOL": "<?xml version='1.0'?>\n<archive><model><material tag='mat1'/></model></archive>\n",
    "a program that writes XML": "<?xml version='1.0'?>\n<data/>\n",
}
ALONE = ("MATVE,2,PRONY,0.25,5e-2\n", "mat1*   3   1.0\n", "/VISC/PRONY/1\n 2\n", "MATFVE  7\n")


def test_every_program_has_a_file_here() -> None:
    assert {program.name for program in PROGRAMS} == set(FILES)


@pytest.mark.parametrize("name", list(FILES))
def test_file_of_a_program_is_refused_by_its_name(name: str, tmp_path: Path) -> None:
    path = tmp_path / "card.dat"
    path.write_text(FILES[name], encoding="utf-8")
    with pytest.raises(ValueError, match="not read; give its constants in a case file") as caught:
        read_card(path, modulus_unit="MPa", time_unit="s")
    assert f"card.dat: is an input file of {name}, which" in str(caught.value)


@pytest.mark.parametrize("text", ALONE)
def test_one_keyword_is_enough(text: str) -> None:
    assert is_card(text)


@pytest.mark.parametrize(
    "text",
    [
        "time [s], E [MPa]\n1, 2\n",
        "creep, time\n1, 2\n",
        "Mat1; Mat2\n1;2\n",
        "# exported from Abaqus\n$ note\nt,G\ns,MPa\n1,2\n",
        "material elastic\nf,E'\n1,2\n",
        "/data/lab/run1\nomega,G'\n1,2\n",
    ],
)
def test_measured_table_is_no_card(text: str) -> None:
    assert program_of(text) is None
    assert not is_card(text)
