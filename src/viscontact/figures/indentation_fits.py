"""Fit of a law to a force curve: contact point, force over approach, and residuals."""

from __future__ import annotations

import numpy as np
import plotly.graph_objects as go

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.look import LIGHT, Look
from viscontact.figures.parts import Part, drawn, numbers
from viscontact.identification import ContactPoint, IndentationFit
from viscontact.identification.contact_point import deflection_in_contact

#: Most points of a measured curve; of longer ones, every so many.
_MOST = 3000
#: Part of the figure above the residuals.
_ABOVE, _BELOW = [0.36, 1.0], [0.0, 0.22]


def contact_point(contact: ContactPoint, look: Look = LIGHT) -> go.Figure:
    """Draw a force curve with its baseline and the elastic body that gives the contact point.

    Parameters
    ----------
    contact : ContactPoint
        From `viscontact.find_contact`.
    look : Look, optional
        Colours and units.

    Returns
    -------
    plotly.graph_objects.Figure
        Deflection over position: the measured rows, the baseline dashed, and the fitted elastic
        body up to the largest position; a thin line marks the contact point.

    Examples
    --------
    >>> from viscontact.identification import ForceCurve, find_contact
    >>> from viscontact.indenters import Sphere
    >>> z = np.linspace(0.0, 3e-6, 301)
    >>> bent = deflection_in_contact(Sphere(5e-6), 1e4, 0.1, z - 2e-6)
    >>> found = find_contact(ForceCurve(z, z, 1e-8 + bent, 0.1), Sphere(5e-6))
    >>> figure = contact_point(found)
    >>> figure.layout.xaxis.title.text, round(figure.layout.shapes[0].x0, 3)
    ('Position [µm]', 2.0)
    """
    curve = contact.curve
    length, bent = look.unit("m", curve.position), look.unit("m", curve.deflection)
    every = slice(None, None, -(-curve.position.size // _MOST))
    along = np.linspace(curve.position.min(), curve.position.max(), 300)
    baseline = contact.offset + contact.slope * along
    elastic = baseline + deflection_in_contact(
        contact.indenter, contact.contact_modulus, curve.spring_constant, along - contact.position
    )
    unit = f"%{{y:.4g}} {bent.symbol}<extra></extra>"
    traces: list[Part] = [
        _dots(length(curve.position[every]), bent(curve.deflection[every]), look, unit),
        _line(length(along), bent(elastic), look.warm, unit),
        _line(length(along), bent(baseline), look.faint, unit) | {"line": _dashed(look.faint)},
    ]
    at = float(length(contact.position))
    mark = {"type": "line", "yref": "paper", "y0": 0, "y1": 1, "x0": at, "x1": at}
    title = f"Deflection [{bent.symbol}]"
    note = "line: elastic body from the contact point on; dashed: baseline"
    return drawn(
        traces,
        look,
        {"name": "fit-contact", "title": title, "note": note},
        xaxis={"title": {"text": length.label("Position")}},
        shapes=[mark | {"line": {"color": look.edge, "width": 1}}],
    )


def force_over_approach(fit: IndentationFit, look: Look = LIGHT) -> go.Figure:
    """Draw force over approach, measured and from the fitted law.

    Parameters
    ----------
    fit : IndentationFit
        From `viscontact.fit_indentation`.
    look : Look, optional
        Colours and units.

    Returns
    -------
    plotly.graph_objects.Figure
        The rows of the record, and the law as a line, in contact and shortly before it.

    Examples
    --------
    >>> from viscontact.identification import IndentationRecord, fit_indentation
    >>> from viscontact.indenters import Sphere
    >>> depth = 1e-6 * np.linspace(0.0, 1.0, 11)
    >>> force = 16 / 3 * 2e6 * np.sqrt(5e-6) * depth**1.5  # Hertz with G = 2 MPa, nu = 0.5
    >>> record = IndentationRecord(Sphere(5e-6), np.linspace(0.0, 1.0, 11), depth, force)
    >>> fit = fit_indentation(record, "elastic", poisson_ratio=0.5)
    >>> force_over_approach(fit).layout.meta["title"]
    'Force [µN]'
    """
    record, counted = fit.record, np.isfinite(fit.residuals)
    length, force = look.unit("m", record.approach), look.unit("N", record.force)
    d, F = (record.approach, fit.fitted) if fit.given == "approach" else (fit.fitted, record.force)
    unit = f"%{{y:.4g}} {force.symbol}<extra></extra>"
    traces = [
        _dots(length(record.approach), force(record.force), look, unit),
        _line(length(d[counted]), force(F[counted]), look.warm, unit),
    ]
    meta = {"name": "fit-loop", "title": force.label("Force"), "note": "points: measured"}
    # Rows before and after contact would leave the contact little room.
    deepest = float(length(record.approach.max()))
    shown = [-0.15 * deepest, 1.05 * deepest]
    across = {"title": {"text": length.label("Approach")}, "range": shown}
    return drawn(traces, look, meta, xaxis=across)


def fit_over_time(fit: IndentationFit, look: Look = LIGHT) -> go.Figure:
    """Draw the fitted quantity over time, and below it the residuals.

    Parameters
    ----------
    fit : IndentationFit
        From `viscontact.fit_indentation`.
    look : Look, optional
        Colours and units.

    Returns
    -------
    plotly.graph_objects.Figure
        Force or approach above, residuals in per cent of the largest value below.

    Examples
    --------
    >>> from viscontact.identification import IndentationRecord, fit_indentation
    >>> from viscontact.indenters import Sphere
    >>> depth = 1e-6 * np.linspace(0.0, 1.0, 11)
    >>> record = IndentationRecord(Sphere(5e-6), np.linspace(0.0, 1.0, 11), depth, depth**1.5)
    >>> fit = fit_indentation(record, "elastic", poisson_ratio=0.5)
    >>> fit_over_time(fit).layout.yaxis2.title.text
    'Residual [%]'
    """
    record, counted = fit.record, np.isfinite(fit.residuals)
    name, si = ("Force", "N") if fit.given == "approach" else ("Approach", "m")
    time, unit = look.unit("s", record.times), look.unit(si, fit.measured)
    text = f"%{{y:.4g}} {unit.symbol}<extra></extra>"
    below = {"yaxis": "y2", "hovertemplate": "%{y:.2f} %<extra></extra>"}
    traces = [
        _dots(time(record.times), unit(fit.measured), look, text),
        _line(time(record.times[counted]), unit(fit.fitted[counted]), look.warm, text),
        _dots(time(record.times), 100 * fit.residuals, look, "") | below,
    ]
    meta = {"name": "fit-time", "title": unit.label(name), "note": "below: residuals"}
    residual = {"title": {"text": "Residual [%]"}, "zeroline": True, "domain": _BELOW}
    return drawn(
        traces,
        look,
        meta,
        xaxis={"title": {"text": time.label("Time")}, "anchor": "y2"},
        yaxis={"domain": _ABOVE},
        yaxis2=residual,
        hovermode="x",
    )


def _dots(x: Floats, y: Floats, look: Look, text: str) -> Part:
    marker = {"color": look.blue, "size": 4}
    both = {"x": numbers(x), "y": numbers(y)}
    return both | {"mode": "markers", "marker": marker, "hovertemplate": text}


def _line(x: Floats, y: Floats, colour: str, text: str) -> Part:
    both = {"x": numbers(x), "y": numbers(y)}
    return both | {"mode": "lines", "line": {"color": colour, "width": 2}, "hovertemplate": text}


def _dashed(colour: str) -> Part:
    return {"color": colour, "width": 1.4, "dash": "dash"}
