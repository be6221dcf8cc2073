"""Load histories: force or approach over time, eccentricity and tilt."""

from viscontact.bodies.loads.approach import ApproachHistory
from viscontact.bodies.loads.force import ForceHistory
from viscontact.bodies.loads.harmonic import HarmonicHistory, harmonic
from viscontact.bodies.loads.harmonic_temperature import HarmonicTemperature
from viscontact.bodies.loads.history import LoadHistory, LoadPoint
from viscontact.bodies.loads.mixed import MixedHistory
from viscontact.bodies.loads.program import Condition, LoadProgram, Segment
from viscontact.bodies.loads.reciprocation import Reciprocation, reciprocating
from viscontact.bodies.loads.standard import ramp, step, triangle
from viscontact.bodies.loads.tangential import TangentialLoad
from viscontact.bodies.loads.tangential_harmonic import TangentialHarmonic, tangential_harmonic
from viscontact.bodies.loads.tangential_history import (
    TangentialHistory,
    tangential_ramp,
    tangential_step,
)
from viscontact.bodies.loads.temperature import TemperatureHistory
from viscontact.bodies.loads.travel import Travel

__all__ = [
    "ApproachHistory",
    "Condition",
    "ForceHistory",
    "HarmonicHistory",
    "HarmonicTemperature",
    "LoadHistory",
    "LoadPoint",
    "LoadProgram",
    "MixedHistory",
    "Reciprocation",
    "Segment",
    "TangentialHarmonic",
    "TangentialHistory",
    "TangentialLoad",
    "TemperatureHistory",
    "Travel",
    "harmonic",
    "ramp",
    "reciprocating",
    "step",
    "tangential_harmonic",
    "tangential_ramp",
    "tangential_step",
    "triangle",
]
