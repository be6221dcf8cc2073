"""Cards of Abaqus and Ansys, and how they are read."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from viscontact.bodies.materials.cards import read_card, read_cards

IN_SI = {"modulus_unit": "Pa", "time_unit": "s"}
IN_MPA = {"modulus_unit": "MPa", "time_unit": "s"}

# E = 3000 and nu = 0.25 make G = 1200 and K = 2000; half of G relaxes.
ABAQUS = """\
*Heading
 a model
** a comment
*Material, name="PMMA 25"
*Density
 1.19e-9,
*elastic, moduli=INSTANTANEOUS
 3000., 0.25
*Viscoelastic, time=PRONY
 0.3, 0., 10.
** between the terms
 0.2, , 1.D2
*Step
*Static
"""
ANSYS = """\
/PREP7
! half of G relaxes
MP,EX,1,3000
mp,prxy,1,0.25   ! instantaneous
MP,DENS,1,1.19e-9
TB,PRONY,1,1,2,SHEAR
TBDATA,1,0.3,10
TBDATA,,0.2,100
"""


def read(folder: Path, text: str, reader: Callable[..., Any] = read_card, **options: Any) -> Any:
    path = folder / "card.txt"
    path.write_text(text, encoding="utf-8")
    return reader(path, **{**IN_MPA, **options})


def problem(folder: Path, text: str, **options: Any) -> str:
    with pytest.raises(ValueError, match=r".") as refusal:
        read(folder, text, read_cards, **options)
    assert "\n" not in str(refusal.value)
    return str(refusal.value)


RELAXATION = """\
*Material, name=T
*Elastic, moduli=INSTANTANEOUS
 3000., 0.25
*Viscoelastic, time=RELAXATION TEST DATA, nmax=3
*Shear Test Data
 0.75, 1.
 0.5, 10.
"""
