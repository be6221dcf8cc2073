"""Named profiles at their best parameter, with which a free one is compared."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
import scipy

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters import CylindricalProfile, FullCrown, LogarithmicProfile
from viscontact.bodies.indenters.logarithmic import JOHNS_GOHAR
from viscontact.bodies.indenters.profile import Profile
from viscontact.studies.design.profiles.loaded_roller import LoadedRoller
from viscontact.studies.design.profiles.minimax import cost
from viscontact.studies.design.profiles.profile_runs import ProfileRuns
from viscontact.units.formatting import format_quantity

#: Amplitudes that are tried, over that of an even line load.
AMPLITUDES = np.geomspace(0.25, 64.0, 9)
#: Tolerance of the logarithm of the best one.
LOG_TOLERANCE = 0.03


@dataclass(frozen=True)
class NamedProfile:
    """Profile of a family, at its best parameter."""

    name: str
    profile: Profile
    parameter: str  # as text
    cost: float  # largest pressure on the cells of the search, with the penalty [Pa]


def amplitude_of(width: float, radius: float) -> float:
    """Amplitude of Lundberg's profile [m] for a contact of some width [m] on a roller."""
    # The half width of a Hertzian line contact is b = 2 sqrt(R A), with A = F'/(pi E*).
    return (width / 2) ** 2 / (4 * radius)


def best_named(runs: ProfileRuns) -> list[NamedProfile]:
    """Cylinder, and best crown, Lundberg and Johns-Gohar profile."""
    own, amplitude = runs.scenarios[0], runs.amplitude
    (rows,) = runs.pressures([[CylindricalProfile()]])
    found = [NamedProfile("cylindrical", CylindricalProfile(), "", cost(rows))]
    for name, family in _families(own).items():
        part, value = _best_part(runs, family)
        profile = family(part * amplitude)
        if value < np.inf and profile is not None:
            found.append(NamedProfile(name, profile, _parameter(profile), value))
    return found


def _families(own: LoadedRoller) -> Mapping[str, Callable[[float], Profile | None]]:
    """Profiles of an amplitude [m]; None where there is none."""
    radius, end = own.roller.radius, own.end

    def crown(amplitude: float) -> Profile | None:
        # The drop at the end is that of a Johns-Gohar profile of usual proportions.
        crown_radius = end**2 / (2 * 4 * amplitude)
        return FullCrown(crown_radius) if crown_radius > 2 * end else None

    def johns_gohar(amplitude: float) -> Profile | None:
        half_width = 2 * np.sqrt(radius * amplitude)
        if half_width >= end:
            return None
        drop = -amplitude * np.log(JOHNS_GOHAR * half_width / end)
        return LogarithmicProfile(amplitude, end_drop=float(drop))

    return {
        "crowned": crown,
        "lundberg": lambda amplitude: LogarithmicProfile(amplitude),
        "johns-gohar": johns_gohar,
    }


def _best_part(runs: ProfileRuns, family: Callable[[float], Profile | None]) -> tuple[float, float]:
    """Best amplitude over that of an even line load, and the cost there."""
    tried: dict[float, float] = {}

    def costs(logs: list[float]) -> list[float]:
        made = [family(float(np.exp(log)) * runs.amplitude) for log in logs]
        found = iter(runs.pressures([[each] for each in made if each is not None]))
        values = [np.inf if each is None else cost(next(found)) for each in made]
        tried.update(zip(logs, values, strict=True))
        return values

    logs = np.log(AMPLITUDES).tolist()
    first = int(np.argmin(costs(logs)))
    low, high = logs[max(first - 1, 0)], logs[min(first + 1, len(logs) - 1)]
    scipy.optimize.minimize_scalar(
        lambda log: min(costs([float(log)])[0], 1e30),
        bounds=(low, high),
        method="bounded",
        options={"xatol": LOG_TOLERANCE},
    )
    best = min(tried, key=lambda log: tried[log])
    return float(np.exp(best)), tried[best]


def _parameter(profile: Profile) -> str:
    if isinstance(profile, FullCrown):
        return f"crown radius {format_quantity(profile.crown_radius or np.nan, 'm', 4)}"
    assert isinstance(profile, LogarithmicProfile)
    return f"amplitude {format_quantity(profile.amplitude, 'm', 4)}"
