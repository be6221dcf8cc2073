"""Interactive figures of a result, as Plotly draws them: in notebooks, the report and the page."""

try:
    from viscontact.drawing.plotly.explorer import explore
except ModuleNotFoundError as error:
    if error.name != "plotly":
        raise
    raise ModuleNotFoundError(
        "interactive figures need Plotly, which is not installed; type: pip install "
        "'viscontact[plot]'",
        name="plotly",
    ) from error

__all__ = ["explore"]
