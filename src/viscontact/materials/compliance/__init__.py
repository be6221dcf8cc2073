"""The contact compliance J(t): the one function of time through which a contact sees the bodies."""

from viscontact.materials.compliance.base import ContactCompliance
from viscontact.materials.compliance.of_law import LawCompliance
from viscontact.materials.compliance.series import SeriesCompliance
from viscontact.materials.compliance.sum import SummedCompliance

__all__ = ["ContactCompliance", "LawCompliance", "SeriesCompliance", "SummedCompliance"]
