"""Half-space under a load that moves at constant speed: compliance and influence coefficients.

In coordinates that move with the load towards +ξ at speed V, the surface at ξ had the load of
ξ + V s a time s ago. With q = K p, the displacement per unit compliance under the elastic
half-space's kernel, a retardation series J(t) = J0 + Σ Ji (1 - exp(-t/λi)) gives the steady
displacement

    u = J0 q + Σ Ji Ei q,   (E q)(ξ) = ∫ exp(-z/l) q(ξ + z) dz/l over z > 0,   l = V λ,

so each cell has the influence coefficient J0 L + Σ Ji Ei L, with L that of Love. It is even across
the motion, but not along it: the surface recovers behind the load.

A wave exp(i k ξ) is multiplied by J0 + Σ Ji/(1 - i k li), the complex compliance at ω = k V.

References
----------
S. C. Hunter, J. Appl. Mech. 28 (1961) 611; I. G. Goryacheva, Contact Mechanics in Tribology,
Kluwer (1998), chapter 6.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import field, replace
from typing import Any, TypeAlias

import numpy as np
import scipy  # its special functions are imported at their first use

from viscontact.backend.arrays import Complexes, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace.influence import influence_coefficient
from viscontact.units.formatting import format_quantity

#: Influence coefficients at offsets along and across the motion [m], for cells of two edges [m].
Coefficient: TypeAlias = Callable[[Floats, Floats, tuple[float, float]], Floats]


def _gauss_rule(count: int) -> tuple[Any, Any, Any]:
    """Nodes and weights of Gauss' rule, and Legendre polynomials at its nodes."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    return nodes, weights, np.polynomial.legendre.legvander(nodes, count - 1)


#: Rules of a panel: interpolation between their nodes is what limits the accuracy. The short one is
#: as accurate on panels of a cell that are FAR_CELLS from the loaded one.
LONG, SHORT, FAR_CELLS = _gauss_rule(10), _gauss_rule(6), 8

#: Panels from an edge of the loaded cell, where L has an infinite slope, to the middle between
#: edges, each half as long as the one before.
GRADED_PANELS = 10

#: Distance of an edge from a whole number of cells that is rounding [cells].
EDGE_ROUNDING = 1e-9

#: Panel lengths over 2 l beyond which a mode is relaxed to rounding.
RELAXED_RATIO = 1e8

#: Growth of the panels beyond the table, and the decay lengths after which they end.
PANEL_GROWTH, DECAY_LENGTHS = 1.5, 45.0


@dataclass(frozen=True, eq=False)
class MovingCompliance:
    """Contact compliance under a load in steady motion, as a series of retardation lengths."""

    instant: float  # J0 [1/Pa]
    amplitudes: Floats  # Ji [1/Pa]
    lengths: Floats  # li = V λi [m]
    #: Way after which the same material returns to the load [m]; inf for a half-space.
    periods: Floats = field(default_factory=lambda: np.empty(0))
    #: Creep beyond the series, ∫ J'(t) dt/(V t): the slope that it gives to the surface around a
    #: line contact, over 2/π times the force on a unit of length [1/(Pa m)].
    drift: float = 0.0

    def __post_init__(self) -> None:
        if not self.periods.size:
            object.__setattr__(self, "periods", np.full(self.lengths.shape, np.inf))

    def of_period(self, period: float) -> tuple[Floats, Floats]:
        """Amplitudes [1/Pa] and lengths [m] of the modes of material with this period [m]."""
        chosen = self.periods == period
        return self.amplitudes[chosen], self.lengths[chosen]

    def split(self) -> tuple[MovingCompliance, MovingCompliance]:
        """Compliance of material that passes once, with J0, and modes of material that returns."""
        once = np.isinf(self.periods)
        passing, returning = (
            replace(
                self,
                amplitudes=self.amplitudes[chosen],
                lengths=self.lengths[chosen],
                periods=self.periods[chosen],
            )
            for chosen in (once, ~once)
        )
        return passing, replace(returning, instant=0.0, drift=0.0)

    @property
    def relaxed(self) -> float:
        """Compliance at rest, J0 + Σ Ji [1/Pa]."""
        return self.instant + float(self.amplitudes.sum())

    def scaled(self, factor: float) -> MovingCompliance:
        """Compliance times a factor."""
        amplitudes = factor * self.amplitudes
        return replace(
            self, instant=factor * self.instant, amplitudes=amplitudes, drift=factor * self.drift
        )

    def at_wave_number(self, wave_number: Floats) -> Complexes:
        """Factor of a wave exp(i k ξ) along the motion, for wave numbers k [1/m]; in 1/Pa."""
        total = np.full(np.shape(wave_number), self.instant, complex)
        for amplitude, length in zip(self.amplitudes, self.lengths, strict=True):
            total += amplitude / (1 - 1j * wave_number * length)
        return total

    def loss_at_wave_number(self, wave_number: Floats) -> Complexes:
        """Factor of a wave in Σ (Ji/li) (q - Ei q), the slope of the delayed part [1/(Pa m)]."""
        total = np.zeros(np.shape(wave_number), complex)
        for amplitude, length in zip(self.amplitudes, self.lengths, strict=True):
            delay = 1j * wave_number * length
            total -= amplitude / length * delay / (1 - delay)
        return total


def joined(parts: Sequence[MovingCompliance]) -> MovingCompliance:
    """Sum of compliances."""
    return MovingCompliance(
        sum(each.instant for each in parts),
        np.concatenate([each.amplitudes for each in parts]),
        np.concatenate([each.lengths for each in parts]),
        np.concatenate([each.periods for each in parts]),
        sum(each.drift for each in parts),
    )


def moving_influence_table(
    shape: tuple[int, int],
    cell_size: tuple[float, float],
    compliance: MovingCompliance,
    axis: int,
    coefficient: Coefficient = influence_coefficient,
    parity: int = 1,
) -> Floats:
    """Displacement into the body per unit pressure of a cell that moves along an axis [m/Pa].

    Entry k of the 2 n - 1 along the axis is k - (n - 1) cells ahead of the loaded one; across are
    the offsets 0, 1, 2, ... `coefficient`: those of an elastic surface at offsets along and across,
    even (parity 1) or odd (-1) along the axis.
    """
    cell = (cell_size[axis], cell_size[1 - axis])
    count = shape[axis]
    offsets = np.arange(count, dtype=np.float64) * cell[0]
    across = np.arange(shape[1 - axis], dtype=np.float64) * cell[1]
    half = compliance.instant * coefficient(offsets[:, None], across[None, :], cell)
    mirrored = half[:0:-1] if parity == 1 else -half[:0:-1]
    table: Floats = np.concatenate([mirrored, half])
    for period in np.unique(compliance.periods):  # none without modes
        modes = compliance.of_period(period)
        table += _delayed(modes, period, (count, parity), across, cell, coefficient)
    return np.ascontiguousarray(table if axis == 0 else table.T)


def _delayed(
    modes: tuple[Floats, Floats],
    period: float,
    counted: tuple[int, int],
    across: Floats,
    cell: tuple[float, float],
    coefficient: Coefficient,
) -> Floats:
    """Delayed part Σ Ji Ei L at signed offsets along the motion, shape (2 count - 1, across)."""
    (count, parity), (amplitudes, lengths) = counted, modes
    last = (count - 1) * cell[0]
    if last >= period / 2:
        span, length = format_quantity(2 * last, "m"), format_quantity(period, "m")
        raise ValueError(f"a table over {span} is longer than the period of {length}")
    ahead = _panel_edges(count, cell[0], DECAY_LENGTHS * float(lengths.max()), period / 2)
    samples = _panel_samples(ahead, across, cell, coefficient)
    # Behind the loaded cell lie the same panels and samples in reverse, or their negatives.
    behind = len(ahead) - 1 if np.isfinite(period) else int(np.searchsorted(ahead, last))
    edges = np.concatenate([-ahead[behind:0:-1], ahead])
    mirrored = [values[::-1] for values in samples[:behind]][::-1]
    samples = (mirrored if parity == 1 else [-values for values in mirrored]) + samples
    table = np.zeros((2 * count - 1, len(across)))
    delayed = np.zeros((len(lengths), len(across)))
    known: dict[tuple[int, float], Floats] = {}  # most panels are alike
    # E at an edge is the integral over its panel, plus exp(-h/l) E at the next edge.
    for start, end, values in reversed(list(zip(edges, edges[1:], samples, strict=False))):
        width = round((end - start) / cell[0], 12)
        key = len(values), width
        if key not in known:
            known[key] = _panel_weights(width * cell[0] / (2 * lengths), len(values))
        delayed *= np.exp(-(end - start) / lengths)[:, None]
        delayed += np.einsum("ij,jk->ik", known[key], values)
        cells = round(start / cell[0])
        if abs(start / cell[0] - cells) < EDGE_ROUNDING and abs(cells) < count:
            table[cells + count - 1] = np.einsum("i,ij->j", amplitudes, delayed)
    if np.isfinite(period):
        # Earlier passes: the recursion begins, at half a period, with the value where it ends.
        offsets = np.arange(1 - count, count) * cell[0]
        decay = np.exp((offsets[:, None] - period / 2) / lengths) / -np.expm1(-period / lengths)
        table += np.einsum("oi,i,ij->oj", decay, amplitudes, delayed)
    return table


def _panel_edges(count: int, cell: float, reach: float, end: float) -> Floats:
    """Edges of the panels from 0 on, those of the table included, to a reach or before an end."""
    graded = cell / 2 * (1 - 0.5 ** np.arange(GRADED_PANELS))
    edges = np.concatenate([graded, [cell / 2], cell - graded[::-1], [1.5 * cell]])
    edges = np.append(edges, cell * np.arange(2, max(count - 1, 2) + 1))
    far, end = float(edges[-1]), min(end, float(edges[-1]) + reach)
    growing = far * PANEL_GROWTH ** np.arange(1, max(np.log(end / far) / np.log(PANEL_GROWTH), 0))
    return np.append(np.concatenate([edges[edges < end], growing[growing < end]]), end)


def _panel_samples(
    edges: Floats,
    across: Floats,
    cell: tuple[float, float],
    coefficient: Coefficient,
) -> list[Floats]:
    """L at the nodes of each panel: of the short rule on panels that are small and far."""
    far = (edges[:-1] >= FAR_CELLS * cell[0]) & (np.diff(edges) <= (1 + EDGE_ROUNDING) * cell[0])
    found: list[Floats] = [np.empty(0)] * len(far)
    for chosen, (nodes, _, _) in ((far, SHORT), (~far, LONG)):
        panels = np.flatnonzero(chosen)
        places = edges[panels, None] + np.diff(edges)[panels, None] * (1 + nodes) / 2
        values = coefficient(places.ravel()[:, None], across[None, :], cell)
        for panel, block in zip(panels, np.split(values, max(len(panels), 1)), strict=False):
            found[panel] = block
    return found


def _panel_weights(ratio: Floats, count: int) -> Floats:
    """Weights at the nodes of a panel from 0 to h for ∫ exp(-z/l) f(z) dz/l; ratio is h/(2 l)."""
    # Exact for polynomials that Gauss' rule interpolates: exp(-a ξ) in Legendre polynomials has the
    # coefficients (2n + 1) (-1)ⁿ i_n(a), modified spherical Bessel functions.
    a = np.minimum(ratio, RELAXED_RATIO)[:, None]
    _, weights, polynomials = SHORT if count == len(SHORT[0]) else LONG
    order = np.arange(count)
    bessel = np.sqrt(np.pi / (2 * a)) * scipy.special.ive(order + 0.5, a)
    coefficients = a * (2 * order + 1) * (-1.0) ** order * bessel
    return np.asarray(np.einsum("in,jn->ij", coefficients, polynomials) * weights)
