"""Files that a case file names, found beside it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from pydantic import AfterValidator, ValidationInfo


def _beside_the_case(name: str, info: ValidationInfo) -> str:
    return str(Path((info.context or {}).get("folder", "."), name))


#: The path of a file, relative to the folder of the case file unless it is absolute.
DataFile = Annotated[str, AfterValidator(_beside_the_case)]
