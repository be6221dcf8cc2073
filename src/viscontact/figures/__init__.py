"""Interactive figures of a result, as Plotly draws them: in notebooks, the report and the page."""

try:
    import plotly
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        "interactive figures need Plotly, which is not installed; type: pip install "
        "'viscontact[plot]'",
        name="plotly",
    ) from error

from viscontact.figures.explorer import explore

#: Version of Plotly.
PLOTLY_VERSION: str = plotly.__version__

__all__ = ["PLOTLY_VERSION", "explore"]
