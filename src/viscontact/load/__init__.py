"""What presses the bodies together, over time."""

from viscontact.load.approach import ApproachHistory
from viscontact.load.force import ForceHistory
from viscontact.load.harmonic import HarmonicHistory
from viscontact.load.history import LoadHistory, LoadPoint
from viscontact.load.shapes import harmonic, ramp, step, triangle

__all__ = [
    "ApproachHistory",
    "ForceHistory",
    "HarmonicHistory",
    "LoadHistory",
    "LoadPoint",
    "harmonic",
    "ramp",
    "step",
    "triangle",
]
