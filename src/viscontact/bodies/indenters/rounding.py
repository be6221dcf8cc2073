"""Remedies for singular pressure: arguments and case-file keys that round a body."""

from __future__ import annotations

from viscontact.bodies.indenters.chamfer import Chamfer
from viscontact.bodies.indenters.crowns import (
    CylindricalProfile,
    FullCrown,
    PartialCrown,
    TwoRadiiCrown,
)
from viscontact.bodies.indenters.faceted import Wedge
from viscontact.bodies.indenters.flat_punch import FlatPunch
from viscontact.bodies.indenters.height_map import HeightMap
from viscontact.bodies.indenters.indenter import CombinedIndenter, Indenter, PlacedIndenter
from viscontact.bodies.indenters.logarithmic import LogarithmicProfile
from viscontact.bodies.indenters.point_bodies import Revolved, Swept
from viscontact.bodies.indenters.profile import Profile
from viscontact.bodies.indenters.roller import Roller
from viscontact.bodies.indenters.sphere_cone import Cone
from viscontact.bodies.indenters.tabulated import TabulatedProfile

#: Remedy for bodies without an argument that rounds them.
_GENERAL = "give the end, edge or tip the radius that it has in reality, over several cells"

_OF_BODIES: dict[type[Indenter], str] = {
    Cone: "round the tip: 'shape: revolved' with 'points' of the tip under indenter",
    FlatPunch: (
        "round or chamfer the edge: under indenter, 'shape: revolved' with 'points' for a round "
        "punch, 'shape: height-map' for a rectangular one"
    ),
    HeightMap: "take more points: 'resample' with 'filter: spline' under indenter, or a finer map",
    Wedge: "round the edge: 'shape: swept' with 'points' of the edge under indenter",
}

_OF_PROFILES: dict[type[Profile], str] = {
    CylindricalProfile: (
        "round or chamfer the ends: 'crown_radius' under indenter, or 'kind: chamfer' with "
        "'corner_radius' under indenter.profile"
    ),
    FullCrown: "let the crown drop more at the end: a smaller 'crown_radius' under indenter",
    PartialCrown: (
        "let the crown drop more at the end: a smaller 'crown_radius' under indenter, or a larger "
        "'end_length' under indenter.profile"
    ),
    TwoRadiiCrown: (
        "let the crown drop more at the end: a smaller 'end_radius' or a larger 'end_length' under "
        "indenter.profile"
    ),
    Chamfer: "round the corner of the chamfer: a larger 'corner_radius' under indenter.profile",
    TabulatedProfile: (
        "round the line and let it drop more at the end: more 'points' and "
        "'interpolation: smooth' under indenter.profile"
    ),
}


def rounding_remedy(indenter: Indenter) -> str:
    """Sentence on how to round a body, so that its largest pressure has a limit."""
    if isinstance(indenter, PlacedIndenter):
        return rounding_remedy(indenter.body)
    if isinstance(indenter, CombinedIndenter):
        found = (rounding_remedy(part) for part in indenter.parts)
        return next((remedy for remedy in found if remedy != _GENERAL), _GENERAL)
    if isinstance(indenter, Roller):
        line = indenter.line
        if isinstance(line, LogarithmicProfile):
            return _for_logarithm(line)
        return _OF_PROFILES.get(type(line), _GENERAL)
    if isinstance(indenter, Revolved | Swept) and indenter.interpolation == "linear":
        return "round the corners between the points: 'interpolation: smooth' under indenter"
    return _OF_BODIES.get(type(indenter), _GENERAL)


def _for_logarithm(line: LogarithmicProfile) -> str:
    if line.end_drop is None:
        return "resolve the end, where the line falls without limit: shorter cells along the roller"
    return (
        "let the line drop more at the end: a larger 'end_drop', 'amplitude' or design 'force' "
        "under indenter.profile"
    )
