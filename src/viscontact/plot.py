"""Figures of a run, of several runs, of a sweep, and of a creep law."""

from viscontact.drawing.matplotlib import *
from viscontact.drawing.matplotlib import __all__ as __all__
