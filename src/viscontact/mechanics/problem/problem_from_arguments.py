"""Contact problem of the arguments of `simulate`, `march` and `steady`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NotRequired, TypedDict, Unpack

from numpy.typing import ArrayLike

from viscontact.bodies.adhesion import Adhesion
from viscontact.bodies.friction import Friction, as_friction
from viscontact.bodies.grid import AutomaticGrid, Grid
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.loads import LoadHistory, LoadProgram
from viscontact.bodies.loads.mixed import as_history
from viscontact.bodies.loads.motion import STANDING, Motion
from viscontact.bodies.loads.tangential import TangentialLoad
from viscontact.bodies.loads.temperature import TemperatureHistory, as_temperature
from viscontact.bodies.materials.body import Body
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.problem.kept_fields import KeptFields
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.time_integration.requested_times import AdaptiveTimes


class Arguments(TypedDict):
    """Arguments of a contact problem, as users give them: see `simulate`."""

    indenter: Indenter
    material: Material | Layered | Body
    load: LoadHistory | LoadProgram
    grid: NotRequired[Grid | AutomaticGrid | None]
    times: NotRequired[ArrayLike | AdaptiveTimes | None]
    indenter_material: NotRequired[Material | Layered | Body | None]
    tolerance: NotRequired[float]
    fields: NotRequired[str | Sequence[float]]
    motion: NotRequired[Motion | None]
    temperature: NotRequired[TemperatureHistory | float | None]
    friction: NotRequired[Friction | float | None]
    adhesion: NotRequired[Adhesion | None]
    tangential: NotRequired[TangentialLoad | None]


def contact_problem(**given: Unpack[Arguments]) -> Problem:
    """Return the contact problem of arguments; what is left out has its default."""
    named: dict[str, Any] = {**given, "load": as_history(given["load"])}
    named["temperature"] = as_temperature(named.get("temperature"))
    named["friction"] = as_friction(named.get("friction"))
    named["kept"] = KeptFields(named.pop("fields", "all"))
    if named.get("motion") is None:
        named["motion"] = STANDING
    return Problem(**named)
