"""The contact compliance J(t): the one function of time through which a contact sees the bodies."""

from viscontact.compliance.contact_compliance import ContactCompliance
from viscontact.compliance.of_law import LawCompliance
from viscontact.compliance.series import SeriesCompliance
from viscontact.compliance.sum import SummedCompliance

__all__ = ["ContactCompliance", "LawCompliance", "SeriesCompliance", "SummedCompliance"]
