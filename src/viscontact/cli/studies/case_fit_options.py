"""Options of `fit --case`, as the arguments of `viscontact.fit_case`."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from viscontact.cli.material.fit_options import FitArguments
from viscontact.cli.terminal.messages import refuse

#: Options by the names of the arguments, at the beginning of a message.
_OPTIONS = {
    "change": "--change",
    "drive": "--drive",
    "contact_point": "--contact-point",
    "machine_stiffness": "--machine-stiffness",
    "rows": "--rows",
    "runs": "--runs",
}


@dataclass(frozen=True)
class CaseFitRequest:
    """Options of `fit --case`, as they were typed."""

    files: Sequence[Path]
    case: Path | None
    change: Sequence[str]  # KEY=LOW:HIGH[:log]
    drive: str | None
    contact_point: str | None  # LOW:HIGH[:log]
    machine_stiffness: str | None
    settings: Sequence[str]  # KEY=VALUE
    rows: int
    runs: int | None
    jobs: int

    @property
    def trials(self) -> Path:
        """File that keeps the runs until the end of the fit."""
        return Path(f"{self.files[0].stem}-fit.jsonl")

    def arguments(self) -> dict[str, Any]:
        """Arguments of `viscontact.fit_case` by name."""
        if not self.change:
            refuse("--change: name an unknown, e.g. --change material.shear_modulus='1 MPa:9 MPa'")
        return {
            "case": self.case,
            "records": list(self.files),
            "change": {key: _bounds(text) for key, text in _keys("--change", self.change).items()},
            "drive": self.drive,
            "contact_point": None if self.contact_point is None else _bounds(self.contact_point),
            "machine_stiffness": (
                None if self.machine_stiffness is None else _bounds(self.machine_stiffness)
            ),
            "settings": _keys("--set", self.settings),
            "rows": self.rows,
            "runs": self.runs,
            "workers": self.jobs,
            "trials": self.trials,
        }

    def require_alone(self, other: FitArguments) -> None:
        """Refuse options of other fits beside ``--case``."""
        given = {
            "--data": other.data,
            "--poisson-ratio": other.poisson_ratio,
            "--bulk-modulus": other.bulk_modulus,
            "--terms": other.terms,
            "--fluid": other.fluid or None,
            "--weight": other.weight or None,
            "--stress": other.stress,
            "--reference": other.reference,
            "--temperature": other.temperature,
            "--indenter": other.indenter,
            "--spring-constant": other.spring_constant,
            "--sensitivity": other.sensitivity,
        }
        idle = [option for option, value in given.items() if value is not None]
        if idle:
            refuse(
                f"{', '.join(idle)} does not go with --case, whose file has body and law; "
                "leave it out"
            )

    def require_none(self) -> None:
        """Refuse options of ``--case`` without it."""
        given = {
            "--change": self.change,
            "--drive": self.drive,
            "--contact-point": self.contact_point,
            "--machine-stiffness": self.machine_stiffness,
            "--set": self.settings,
            "--runs": self.runs,
        }
        idle = [option for option, value in given.items() if value]
        if idle or len(self.files) > 1:
            what = ", ".join(idle) or f"{len(self.files)} tables"
            refuse(f"{what}: needs --case CASE.yaml, the case of the experiment")


def as_typed(message: str) -> str:
    """Message about an argument of `viscontact.fit_case`, with the option that was typed.

    >>> as_typed("machine_stiffness: must be above zero")
    '--machine-stiffness: must be above zero'
    """
    name = re.match(r"\w+(?=: )", message)
    option = _OPTIONS.get(name.group() if name else "")
    return message if name is None or option is None else option + message[name.end() :]


def _keys(option: str, texts: Sequence[str]) -> dict[str, str]:
    """Texts behind the equals signs, by key."""
    found: dict[str, str] = {}
    for text in texts:
        key, equals, given = (part.strip() for part in text.partition("="))
        if not (key and equals and given):
            wanted = "KEY=LOW:HIGH or KEY=LOW:HIGH:log" if option == "--change" else "KEY=VALUE"
            refuse(f"{option} {text}: write {wanted}, with units")
        if key in found:
            refuse(f"{option} {key}: is given twice; give it once")
        found[key] = given
    return found


def _bounds(text: str) -> tuple[str, ...]:
    """Parts of a range."""
    return tuple(part.strip() for part in text.split(":"))
