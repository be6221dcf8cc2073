"""Files of a profile design: the profile for a grinding machine, the best case, and the table."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.runs.directory.atomic_files import replacing
from viscontact.studies.design.profiles.result import ProfileDesign
from viscontact.studies.design.profiles.tables import RESOLUTION
from viscontact.studies.study_files import BEST_NAME, TRIALS_NAME, write_case, write_table

#: The profile as a table, which a case takes as well, and as a drawing.
CSV_NAME, DXF_NAME = "profile.csv", "profile.dxf"
#: Digits of a drop [um].
_DIGITS = round(-np.log10(RESOLUTION * 1e6))


def write_profile_design(directory: Path, found: ProfileDesign) -> None:
    """Write the profile as CSV, the best case with it, and the table of all profiles."""
    with replacing(directory / CSV_NAME) as file:
        file.write(profile_csv(found.x, found.drop).encode())
    write_case(directory / BEST_NAME, found.best_case(directory / CSV_NAME))
    write_table(directory / TRIALS_NAME, found.table)


def profile_csv(x: Floats, drop: Floats) -> str:
    """Profile as CSV text, positions in mm and drops in um."""
    rows = (
        f"{1e3 * place:.12g},{1e6 * level:.{_DIGITS}f}\n"
        for place, level in zip(x.tolist(), drop.tolist(), strict=True)
    )
    return "".join(["x [mm],drop [um]\n", *rows])
