"""Roller of a case under the load of a scenario, and the same with another profile."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Roller
from viscontact.bodies.indenters.profile import Profile
from viscontact.bodies.laws import Elastic
from viscontact.bodies.materials.body import Body
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.case import Case
from viscontact.studies.case_values import case_with
from viscontact.studies.design.scenarios import Scenario

#: Largest excess of a body over the end of a roller, relative to its half length.
SAME = 1e-6


@dataclass(frozen=True, eq=False)
class LoadedRoller:
    """Case whose indenter is a roller with an end, in a scenario."""

    name: str
    case: Case

    @property
    def roller(self) -> Roller:
        """Roller of the case."""
        assert isinstance(self.case.indenter, Roller)
        return self.case.indenter

    @property
    def end(self) -> float:
        """Half of the total length [m]."""
        return self.roller.end

    @property
    def may_touch_ends(self) -> bool:
        """True if pressure is limited there, as the half-space ends with the roller, or before."""
        body, last = self.case.material, self.end * (1 + SAME)
        if not isinstance(body, Body) or body.ends != ("free", "free"):
            return False
        return all(plane is not None and abs(plane) <= last for plane in body.planes)

    @property
    def has_given_tilt(self) -> bool:
        """True if the tilt along the roller is prescribed."""
        return self.case.load.tilt_x is not None

    def arguments(self, profile: Profile | None = None) -> dict[str, Any]:
        """Arguments of `simulate`, with another profile if one is given."""
        names = ("material", "load", "grid", "times", "indenter_material", "tolerance", "errors")
        found = {name: getattr(self.case, name) for name in (*names, "temperature")}
        return {**found, "indenter": self.roller if profile is None else self.with_profile(profile)}

    def certifying(self, profile: Profile | None, grid: Grid) -> dict[str, Any]:
        """Arguments of a run on the cells of the case if it gives them, else on fine ones."""
        # The profile of the case has its own automatic grid: its contact may be wider.
        keeps = profile is None or isinstance(self.case.grid, Grid)
        return self.arguments(profile) | ({} if keeps else {"grid": grid})

    def with_profile(self, profile: Profile) -> Roller:
        """Roller of the same radius and total length with another profile."""
        own = self.roller
        return Roller(own.radius, self.end, profile=profile, cross_section=own.cross_section)


def loaded_rollers(
    case: Path, settings: Mapping[str, str], scenarios: Sequence[Scenario]
) -> tuple[LoadedRoller, ...]:
    """Rollers of the scenarios; ValueError names what a free profile cannot be designed for."""
    found = tuple(
        LoadedRoller(each.name, case_with(case, {**settings, **each.values})) for each in scenarios
    )
    for each in found:
        _require_roller(each.case, case)
    if len({each.end for each in found}) > 1:
        raise ValueError("over: the scenarios have rollers of different lengths")
    return found


def case_with_table(case: Path, settings: Mapping[str, str], end: float, table: str) -> Case:
    """The case with a table as its profile, a file next to the case file or an absolute path."""
    own = case_with(case, settings)
    data = dict(own.document.data["indenter"])
    for key in ("crown_radius", "profile"):
        data.pop(key, None)
    data |= {"half_length": f"{end * 1e3:.12g} mm", "profile": {"kind": "table", "file": table}}
    return case_with(case, {**settings, "indenter": json.dumps(data)})


def _require_roller(case: Case, path: Path) -> None:
    if not isinstance(case.indenter, Roller):
        raise ValueError(f"{path}: indenter: a free profile is that of one roller")
    # A crown that is not cut off ends where it meets the axis.
    if not float(case.indenter.drop(0.99 * case.indenter.end)) < case.indenter.radius / 4:
        raise ValueError(
            f"{path}: indenter: the roller has no end; give length, its total length, e.g. '30 mm'"
        )
    if not case.motion.stands:
        raise ValueError(f"{path}: motion: a free profile takes a standing contact")
    if case.adaptive is not None:
        raise ValueError(
            f"{path}: time.spacing: adaptive steps differ from trial to trial; give uniform or log"
        )
    if any(getattr(case.grid, "periodic", (False, False))):
        raise ValueError(f"{path}: grid.periodic: a roller with ends takes a grid without periods")


def without_creep(scenarios: Sequence[LoadedRoller]) -> dict[str, Any] | None:
    """Materials of all scenarios with their instant compliance; None if there is no common one."""
    names = ("material", "indenter_material")
    bodies = [{name: getattr(each.case, name) for name in names} for each in scenarios]
    instant = {name: _instant(body) for name, body in bodies[0].items()}
    is_known = all((instant[name] is None) == (bodies[0][name] is None) for name in names)
    same = all(each == bodies[0] for each in bodies)
    return instant if same and is_known and instant != bodies[0] else None


def _instant(body: Material | Layered | None) -> Material | None:
    """Body without creep: itself if it is elastic, None without an instant compliance or layers."""
    if not isinstance(body, Material):
        return None
    if isinstance(body.law, Elastic):
        return body
    compliance = float(body.law(0.0))
    return None if compliance == 0 else replace(body, law=Elastic(1 / (2 * compliance)))
