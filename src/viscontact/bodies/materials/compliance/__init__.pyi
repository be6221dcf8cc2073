from .base import ContactCompliance
from .of_law import LawCompliance
from .on_clock import ClockedCompliance
from .series import SeriesCompliance
from .sum import SummedCompliance

__all__ = [
    "ClockedCompliance",
    "ContactCompliance",
    "LawCompliance",
    "SeriesCompliance",
    "SummedCompliance",
]
