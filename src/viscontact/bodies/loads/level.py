"""Prescribed level of a load, a force or an approach: checks of its arguments."""

from __future__ import annotations

from viscontact.bodies.loads.history import Control
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import finite, positive


def prescribed_level(
    history: str, force: float | None, approach: float | None, force_is: str = "force"
) -> tuple[Control, float]:
    """Return what is prescribed, and its force [N] or approach [m]; exactly one is given."""
    if (force is None) == (approach is None):
        what = "missing" if force is None else "given twice"
        raise ValueError(
            f"{history}: {force_is} is {what}; give {force_is}= in N or approach= in m, and only "
            "one of them"
        )
    if approach is not None:
        return "approach", finite(f"{history}: approach", approach, "m")
    return "force", finite(f"{history}: {force_is}", force, "N")


def positive_duration(name: str, value: float | None) -> float:
    """Return a duration [s], or raise ValueError unless it is positive and finite."""
    try:
        return positive(name, value, "s")
    except ValueError as error:
        remedy = "for a jump use step(...) or a repeated time in ForceHistory"
        raise ValueError(f"{error}; {remedy}") from None


def refuse_eccentric_approach(eccentricity_x: float, eccentricity_y: float) -> None:
    """Raise ValueError if an eccentricity [m] is given with an approach."""
    for name, value in (("eccentricity_x", eccentricity_x), ("eccentricity_y", eccentricity_y)):
        if value:
            raise ValueError(
                f"{name} goes with a force, got {format_quantity(value, 'm', 9)} with an approach: "
                "no force is prescribed that could act there; leave it out, or prescribe the tilt"
            )


def refuse_stage(stage_stiffness: object) -> None:
    """Raise ValueError for a spring of a stage under a prescribed force."""
    if stage_stiffness is not None:
        raise ValueError(
            "stage_stiffness goes with a prescribed approach: a force acts on the body itself; "
            "leave it out, or prescribe the approach of the stage"
        )
