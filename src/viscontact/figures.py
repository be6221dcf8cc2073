"""Interactive figures of a result, as Plotly draws them: in notebooks, the report and the page."""

from viscontact.drawing.plotly import *
from viscontact.drawing.plotly import __all__ as __all__
