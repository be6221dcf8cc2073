"""Load histories: force or approach over time, eccentricity and tilt."""

from viscontact.loads.approach import ApproachHistory
from viscontact.loads.force import ForceHistory
from viscontact.loads.harmonic import HarmonicHistory, harmonic
from viscontact.loads.history import LoadHistory, LoadPoint
from viscontact.loads.mixed import MixedHistory
from viscontact.loads.program import Condition, LoadProgram, Segment
from viscontact.loads.reciprocation import Reciprocation, reciprocating
from viscontact.loads.standard import ramp, step, triangle
from viscontact.loads.travel import Travel

__all__ = [
    "ApproachHistory",
    "Condition",
    "ForceHistory",
    "HarmonicHistory",
    "LoadHistory",
    "LoadPoint",
    "LoadProgram",
    "MixedHistory",
    "Reciprocation",
    "Segment",
    "Travel",
    "harmonic",
    "ramp",
    "reciprocating",
    "step",
    "triangle",
]
