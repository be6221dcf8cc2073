"""A run as one self-contained page of HTML, to look at and to send."""

try:
    import plotly
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        "a report needs Plotly, which is not installed; type: pip install 'viscontact[plot]'",
        name="plotly",
    ) from error

from viscontact.report.page import report_page, write_report
from viscontact.report.sweep_page import sweep_page, write_sweep_report

#: Of whose scripts a page holds a copy.
PLOTLY_VERSION: str = plotly.__version__

__all__ = ["PLOTLY_VERSION", "report_page", "sweep_page", "write_report", "write_sweep_report"]
