"""Runs and studies as self-contained pages of HTML, to look at and to send."""

from viscontact.report.design_page import write_design_report
from viscontact.report.fit_page import write_fit_report
from viscontact.report.heat_page import write_heat_report
from viscontact.report.page import report_page, write_report
from viscontact.report.profile_page import write_profile_report
from viscontact.report.sensitivity_page import write_sensitivity_report
from viscontact.report.sweep_page import sweep_page, write_sweep_report

__all__ = [
    "report_page",
    "sweep_page",
    "write_design_report",
    "write_fit_report",
    "write_heat_report",
    "write_profile_report",
    "write_report",
    "write_sensitivity_report",
    "write_sweep_report",
]
