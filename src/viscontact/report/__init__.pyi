from .design_page import write_design_report
from .fit_page import write_fit_report
from .heat_page import write_heat_report
from .page import report_page, write_report
from .profile_page import write_profile_report
from .sensitivity_page import write_sensitivity_report
from .sweep_page import sweep_page, write_sweep_report

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
