"""Remedies for singular pressure: arguments and case-file keys that round a body."""

from __future__ import annotations

from typing import TYPE_CHECKING

from viscontact.bodies import indenters
from viscontact.bodies.indenters.cut_body import CutBody
from viscontact.bodies.indenters.indenter import CombinedIndenter, Indenter, PlacedIndenter

if TYPE_CHECKING:
    from viscontact.bodies.indenters.logarithmic import LogarithmicProfile
    from viscontact.bodies.indenters.profile import Profile

#: Remedy for bodies without an argument that rounds them.
_GENERAL = "give the end, edge or tip the radius that it has in reality, over several cells"


def rounding_remedy(indenter: Indenter) -> str:
    """Sentence on how to round a body, so that its largest pressure has a limit."""
    if isinstance(indenter, PlacedIndenter | CutBody):
        return rounding_remedy(indenter.body)
    if isinstance(indenter, CombinedIndenter):
        found = (rounding_remedy(part) for part in indenter.parts)
        return next((remedy for remedy in found if remedy != _GENERAL), _GENERAL)
    if isinstance(indenter, indenters.Roller):
        line = indenter.line
        if isinstance(line, indenters.LogarithmicProfile):
            return _for_logarithm(line)
        return _of_profiles().get(type(line), _GENERAL)
    if (
        isinstance(indenter, indenters.Revolved | indenters.Swept)
        and indenter.interpolation == "linear"
    ):
        return "round the corners between the points: 'interpolation: smooth' under indenter"
    return _of_bodies().get(type(indenter), _GENERAL)


def _for_logarithm(line: LogarithmicProfile) -> str:
    if line.end_drop is None:
        return "resolve the end, where the line falls without limit: shorter cells along the roller"
    return (
        "let the line drop more at the end: a larger 'end_drop', 'amplitude' or design 'force' "
        "under indenter.profile"
    )


def _of_bodies() -> dict[type[Indenter], str]:
    """Remedies by the kind of body; the kinds are loaded where a remedy is asked for."""
    return {
        indenters.Cone: "round the tip: 'shape: revolved' with 'points' of the tip under indenter",
        indenters.FlatPunch: (
            "round or chamfer the edge: under indenter, 'shape: revolved' with 'points' for a "
            "round punch, 'shape: height-map' for a rectangular one"
        ),
        indenters.HeightMap: (
            "take more points: 'resample' with 'filter: spline' under indenter, or a finer map"
        ),
        indenters.Wedge: "round the edge: 'shape: swept' with 'points' of the edge under indenter",
    }


def _of_profiles() -> dict[type[Profile], str]:
    """Remedies by the kind of a roller's profile."""
    return {
        indenters.CylindricalProfile: (
            "round or chamfer the ends: 'crown_radius' under indenter, or 'kind: chamfer' with "
            "'corner_radius' under indenter.profile"
        ),
        indenters.FullCrown: (
            "let the crown drop more at the end: a smaller 'crown_radius' under indenter"
        ),
        indenters.PartialCrown: (
            "let the crown drop more at the end: a smaller 'crown_radius' under indenter, or a "
            "larger 'end_length' under indenter.profile"
        ),
        indenters.TwoRadiiCrown: (
            "let the crown drop more at the end: a smaller 'end_radius' or a larger 'end_length' "
            "under indenter.profile"
        ),
        indenters.Chamfer: (
            "round the corner of the chamfer: a larger 'corner_radius' under indenter.profile"
        ),
        indenters.TabulatedProfile: (
            "round the line and let it drop more at the end: more 'points' and "
            "'interpolation: smooth' under indenter.profile"
        ),
    }
