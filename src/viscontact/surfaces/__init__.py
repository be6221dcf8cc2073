"""Measured surfaces: reading, repair, levelling, resampling, and conversion to an indenter."""

from viscontact.surfaces.cropping import cropped, flipped, swept
from viscontact.surfaces.levelling import levelled
from viscontact.surfaces.missing import filled
from viscontact.surfaces.plausibility import surface_doubts
from viscontact.surfaces.power_spectrum import PowerSpectrum, power_spectrum
from viscontact.surfaces.pressing import indenter_of
from viscontact.surfaces.reader import read_surface
from viscontact.surfaces.resampling import resampled
from viscontact.surfaces.surface import Surface
from viscontact.surfaces.topographies import surface_of, topography_of

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
