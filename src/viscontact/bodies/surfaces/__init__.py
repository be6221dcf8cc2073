"""Measured surfaces: reading, repair, levelling, resampling, and conversion to an indenter."""

from viscontact.bodies.surfaces.cropping import cropped, flipped, swept
from viscontact.bodies.surfaces.levelling import levelled
from viscontact.bodies.surfaces.missing import filled
from viscontact.bodies.surfaces.plausibility import surface_doubts
from viscontact.bodies.surfaces.power_spectrum import PowerSpectrum, power_spectrum
from viscontact.bodies.surfaces.pressing import indenter_of
from viscontact.bodies.surfaces.reader import read_surface
from viscontact.bodies.surfaces.resampling import resampled
from viscontact.bodies.surfaces.surface import Surface
from viscontact.bodies.surfaces.topographies import surface_of, topography_of

__all__ = [
    "PowerSpectrum",
    "Surface",
    "cropped",
    "filled",
    "flipped",
    "indenter_of",
    "levelled",
    "power_spectrum",
    "read_surface",
    "resampled",
    "surface_doubts",
    "surface_of",
    "swept",
    "topography_of",
]
