"""Marginal likelihood of the shift factors of all sets, with one smooth curve for each response.

ln(value) = f_c(ln t - ln a) + ln b + noise (minus ln b for a compliance), where each curve f_c is a
penalized spline. For given ln a this is linear and normal, so the curves and ln b are integrated
out exactly. The likelihood of the best curves in place of this integral is rugged, because a curve
follows the scatter of each set where the others have no rows.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.identification.measured_sets import MeasuredSets
from viscontact.identification.penalized_splines import PenalizedSplines
from viscontact.identification.vertical_shift import VerticalShift


@dataclass(frozen=True, eq=False)
class Joined:
    """Most likely curves and ln b for given ln a, of which the anchor's is left out."""

    cost: float  # -2 ln(likelihood), up to a constant of the sets
    slope: Floats  # its derivative by ln a, shape (sets - 1,)
    logs_b: Floats  # ln b, shape (sets,)
    residuals: Floats  # of ln(value), shape (columns, rows)
    freedom: Floats  # degrees of freedom of the residuals, shape (columns,)
    information: Floats  # expected second derivative of cost/2 by ln a, shape (sets - 1, sets - 1)
    by_shift: Floats  # derivative of ln b by ln a, shape (sets - 1, sets - 1)
    covariance_b: Floats  # of ln b at these ln a, shape (sets - 1, sets - 1)


@dataclass(frozen=True, eq=False)
class JointLikelihood:
    """Likelihood of ln a relative to the set `anchor`, for given noise and roughness."""

    sets: MeasuredSets
    vertical: VerticalShift
    splines: PenalizedSplines
    noise: Floats  # σ of each response
    roughness: Floats  # τ of each response
    trust: Floats  # of the prior of each vertical step
    anchor: int

    def cost(self, shifts: Floats) -> tuple[float, Floats]:
        """-2 ln(likelihood) of ln a of all sets but the anchor, and its derivative."""
        joined = self.joined(shifts)
        return joined.cost, joined.slope

    def joined(self, shifts: Floats) -> Joined:
        """Curves and ln b for ln a of all sets but the anchor, and their likelihood."""
        sets, splines, moved = self.sets, self.splines, self._moved
        places = sets.log_times - moved @ shifts
        design, slopes = self._design(splines.values(places)), splines.slopes(places)
        weighted = design * self._weights[:, None]
        normal = design.T @ weighted + self._precision
        factor = scipy.linalg.cho_factor(normal, lower=True)
        inverse = scipy.linalg.cho_solve(factor, np.eye(len(normal)))
        solved = inverse @ (weighted.T @ self._values + self._precision @ self._mean)
        residuals = self._values - design @ solved
        off = solved - self._mean
        cost = float(
            residuals @ (self._weights * residuals)
            + off @ self._precision @ off
            + 2 * np.sum(np.log(np.diag(factor[0])))
            + self._normalisation
        )
        # Derivatives of the curves by ln a are minus those by ln(time).
        shared = inverse @ weighted.T
        rows = sets.log_times.size
        moves, turned = self._moves(slopes, solved, shared)
        pull = moves.T @ (self._weights * residuals)
        bend = sum(turned.reshape(sets.columns, rows)) @ moved
        crossed = shared @ moves
        information = moves.T @ (self._weights[:, None] * moves) - moves.T @ (weighted @ crossed)
        taken = np.sum(design * shared.T, axis=1).reshape(sets.columns, rows)
        return Joined(
            cost,
            -2 * pull - 2 * bend,
            self._vertical_logs(solved),
            residuals.reshape(sets.columns, rows),
            rows - taken.sum(axis=1),
            information,
            -crossed[self._of_b],
            inverse[self._of_b, self._of_b],
        )

    def _moves(self, slopes: Floats, solved: Floats, shared: Floats) -> tuple[Floats, Floats]:
        """Derivatives of the curves by ln a, and of their design by the own one, of all columns."""
        rows, count = self.sets.log_times.size, self.splines.count
        moves, turned = [], []
        for column in range(self.sets.columns):
            own = slice(column * count, (column + 1) * count)
            moves.append(-(slopes @ solved[own])[:, None] * self._moved)
            at = slice(column * rows, (column + 1) * rows)
            turned.append(np.sum(slopes * shared[own, at].T, axis=1))
        return np.concatenate(moves), np.concatenate(turned)

    @property
    def _of_b(self) -> slice:
        """Unknowns that are ln b; none where it is given."""
        return slice(self.sets.columns * self.splines.count, None)

    @cached_property
    def _moved(self) -> Floats:
        """1 where a row belongs to a set that is not the anchor, shape (rows, sets - 1)."""
        others = np.delete(np.arange(self.sets.count), self.anchor)
        belongs = self.sets.owner[:, None] == others
        return np.asarray(belongs, dtype=np.float64)

    @cached_property
    def _values(self) -> Floats:
        """Values of all responses, less a given vertical shift, shape (columns * rows,)."""
        logs = self.sets.log_columns
        given = self.vertical.given
        if given is not None:
            logs = logs - self.sets.sign * (given - given[self.anchor])[self.sets.owner]
        return np.asarray(logs.ravel())

    @cached_property
    def _weights(self) -> Floats:
        return np.asarray((self.sets.weights / self.noise[:, None] ** 2).ravel())

    @cached_property
    def _precision(self) -> Floats:
        """Prior precision of the unknowns."""
        curves = [self.splines.penalty / tau**2 for tau in self.roughness]
        return np.asarray(scipy.linalg.block_diag(*curves, *self._precision_b))

    @cached_property
    def _precision_b(self) -> tuple[Floats, ...]:
        """Prior precision of ln b, where it is found."""
        if not self.vertical.is_found:
            return ()
        covariance = self.vertical.covariance(self.trust, self.anchor)
        others = np.delete(np.arange(self.sets.count), self.anchor)
        return (np.asarray(scipy.linalg.inv(covariance[np.ix_(others, others)])),)

    @cached_property
    def _mean(self) -> Floats:
        """Prior mean of the unknowns: 0 for curves, whose level and slope are free."""
        curves = np.zeros(self.sets.columns * self.splines.count)
        if not self.vertical.is_found:
            return curves
        return np.concatenate([curves, np.delete(self.vertical.expected(self.anchor), self.anchor)])

    @cached_property
    def _normalisation(self) -> float:
        """Part of the cost that the unknowns do not change."""
        rank = self.splines.count - 2
        priors = self.sets.columns * self.splines.log_penalty
        priors -= 2 * rank * float(np.sum(np.log(self.roughness)))
        for precision in self._precision_b:
            priors += float(np.linalg.slogdet(precision)[1])
        return 2 * self.sets.log_times.size * float(np.sum(np.log(self.noise))) - priors

    def _design(self, spline: Floats) -> Floats:
        """Effect of all unknowns on all values."""
        curves = scipy.linalg.block_diag(*[spline] * self.sets.columns)
        if not self.vertical.is_found:
            return np.asarray(curves)
        raised = np.tile(self.sets.sign * self._moved, (self.sets.columns, 1))
        return np.concatenate([curves, raised], axis=1)

    def _vertical_logs(self, solved: Floats) -> Floats:
        given = self.vertical.given
        if given is not None:
            return np.asarray(given - given[self.anchor])
        return np.insert(solved[self._of_b], self.anchor, 0.0)
