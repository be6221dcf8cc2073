"""What presses the bodies together, over time."""

from viscontact.load.history import ForceHistory, LoadPoint
from viscontact.load.shapes import ramp, step, triangle

__all__ = ["ForceHistory", "LoadPoint", "ramp", "step", "triangle"]
