from .approach import ApproachHistory
from .force import ForceHistory
from .harmonic_history import HarmonicHistory, harmonic
from .harmonic_temperature import HarmonicTemperature
from .history import LoadHistory, LoadPoint
from .mixed import MixedHistory
from .program import Condition, LoadProgram, Segment
from .reciprocation import Reciprocation, reciprocating
from .standard import ramp, step, triangle
from .tangential import TangentialLoad
from .tangential_harmonic_history import TangentialHarmonic, tangential_harmonic
from .tangential_history import (
    TangentialHistory,
    tangential_ramp,
    tangential_step,
)
from .temperature import TemperatureHistory
from .travel import Travel

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
