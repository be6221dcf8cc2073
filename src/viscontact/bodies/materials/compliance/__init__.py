"""Contact compliance J(t), the function of time by which a contact depends on the materials."""

from viscontact.bodies.materials.compliance.base import ContactCompliance
from viscontact.bodies.materials.compliance.of_law import LawCompliance
from viscontact.bodies.materials.compliance.on_clock import ClockedCompliance
from viscontact.bodies.materials.compliance.series import SeriesCompliance
from viscontact.bodies.materials.compliance.sum import SummedCompliance

__all__ = [
    "ClockedCompliance",
    "ContactCompliance",
    "LawCompliance",
    "SeriesCompliance",
    "SummedCompliance",
]
