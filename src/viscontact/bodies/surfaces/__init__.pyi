from .cropping import cropped, flipped, swept
from .height_spectrum import PowerSpectrum, power_spectrum
from .levelling import levelled
from .missing import filled
from .plausibility import surface_doubts
from .pressing import indenter_of
from .reader import read_surface
from .resampling import resampled
from .surface import Surface
from .topographies import surface_of, topography_of

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
