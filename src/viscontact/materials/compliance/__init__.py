"""Contact compliance J(t), the function of time by which a contact depends on the materials."""

from viscontact.materials.compliance.base import ContactCompliance
from viscontact.materials.compliance.of_law import LawCompliance
from viscontact.materials.compliance.series import SeriesCompliance
from viscontact.materials.compliance.sum import SummedCompliance

__all__ = ["ContactCompliance", "LawCompliance", "SeriesCompliance", "SummedCompliance"]
