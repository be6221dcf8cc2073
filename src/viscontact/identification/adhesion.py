"""Fit of work of adhesion, range and modulus to a force curve of a sphere."""

from __future__ import annotations

import math
from dataclasses import field
from warnings import warn

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import AccuracyWarning
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.threads import limit_threads
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.laws import Elastic
from viscontact.bodies.materials.material import Material
from viscontact.identification.adhesion_fit import AdhesionFit
from viscontact.identification.adhesive_problem import AdhesiveProblem, AdhesiveRows
from viscontact.identification.elastic_indentation import indenter_profile
from viscontact.identification.estimation import Estimate, estimated
from viscontact.identification.fit_quality import SMALL, WIDENED
from viscontact.identification.fitted_contact import FittedContact
from viscontact.identification.force_curve import ForceCurve
from viscontact.reference import SphereProfile

#: Tabor numbers that a fit can determine: beyond them the curves are those of the limits.
_LEAST_TABOR, _LARGEST_TABOR = 0.02, 20.0
#: Tabor numbers of an interval under which the other values are found.
_TRIED = 6
#: Tabor numbers that are tried first.
_SCANNED = 9


def fit_adhesion(
    curve: ForceCurve, indenter: Indenter, *, poisson_ratio: float, confidence: float = 0.95
) -> AdhesionFit:
    """Fit work of adhesion, range, modulus and contact point to approach and retraction of a tip.

    Parameters
    ----------
    curve : ForceCurve
        The measured curve of an elastic body: it begins before contact, and its retraction pulls.
    indenter : Sphere or Paraboloid
        The tip, or a paraboloid of the relative radius of two spheres.
    poisson_ratio : float
        Poisson's ratio of the body.
    confidence : float, optional
        Level of the intervals, between 0 and 1.

    Returns
    -------
    AdhesionFit
        Parameters, intervals, Tabor number, contact point and baseline.

    Raises
    ------
    ValueError
        If an argument does not fit, or the curve shows no pull-off.

    Warns
    -----
    AccuracyWarning
        If the residuals are no noise, as where the body creeps.

    Notes
    -----
    Least squares of the deflection in the logarithms of modulus and work, with the position of the
    first touch and a line as further unknowns, under the Tabor number where they are least. The
    contact is that of Maugis (1992) on the spring of the cantilever, stable up to the position at
    which the base is pulled off. The rows beside jumps do not count, nor does where a jump occurs,
    which noise brings forward. The search begins at the work and the modulus that two points give
    in the limit of Johnson, Kendall and Roberts: pull-off, and no force.

    The interval of the Tabor number contains those for which the least squares exceed the least
    ones by no more than Student's t allows (profile likelihood). Where that of no range is among
    them, the range is not determined, and the parameters are those of no range. The other intervals
    cover those of the linearised models under all Tabor numbers of the interval, as modulus and
    work depend strongly, and not linearly, on one that the curve hardly tells.

    Of a body that creeps, values are fitted by runs: `fit_case`, from a case with a section
    ``adhesion`` and a ``stage_stiffness``.

    Examples
    --------
    >>> from viscontact.bodies.indenters import Sphere
    >>> from viscontact.identification.adhesive_branch import adhesive_branch
    >>> force, depth = adhesive_branch(np.inf, 2.5)  # of a body of 10 MPa and 50 mJ/m²
    >>> z = np.concatenate([np.linspace(-2e-7, 0, 50), np.linspace(1e-9, 2e-7, 80)])
    >>> z = np.concatenate([z, z[::-1]])
    >>> unit, length = np.pi * 0.05 * 1e-6, np.cbrt((np.pi * 0.05 * 0.75e-7) ** 2 * 1e-6)
    >>> base = length * depth + unit * force / 5.0  # on a spring of 5 N/m
    >>> end = int(np.argmin(base))
    >>> bent = unit / 5.0 * np.interp(z, base[end::-1], force[end::-1])
    >>> bent[(z < 0) & (np.arange(z.size) < 130) | (z < base[end])] = 0.0
    >>> curve = ForceCurve(np.arange(260.0), z, bent, 5.0)
    >>> fit = fit_adhesion(curve, Sphere(1e-6), poisson_ratio=0.5)
    >>> f"{fit.parameters['work']:.3f} {fit.units[1]}, {fit.parameters['contact_modulus']:.3g} Pa"
    '0.050 J/m^2, 1e+07 Pa'
    """
    if not 0 < confidence < 1:
        raise ValueError(f"fit_adhesion: confidence must lie between 0 and 1, got {confidence!r}")
    profile = indenter_profile(indenter)
    if not isinstance(profile, SphereProfile):
        raise ValueError(
            f"fit_adhesion: the tip must be a Sphere or a round Paraboloid, got {indenter!r}; "
            "another one is fitted by runs, with fit_case"
        )
    Material(Elastic(1.0), poisson_ratio=poisson_ratio)  # checks Poisson's ratio
    with limit_threads():  # on matrices this small, more threads mostly wait
        problem = AdhesiveProblem(AdhesiveRows.of(curve), profile.radius, math.inf)
        fit = _Search(problem, confidence).fit(poisson_ratio)
    if fit.widening > WIDENED and fit.residual > SMALL:
        text = (
            f"fit_adhesion: the residuals ({100 * fit.residual:.2g} % of the largest force) are "
            "not noise: the body creeps, or the tip has another shape; for a body that creeps take "
            f"fit_case. The intervals are up to {fit.widening:.2g} times as wide for that"
        )
        warn(text, AccuracyWarning, stacklevel=2)
    return fit


@dataclass(frozen=True, eq=False)
class _Search:
    """Least squares under each Tabor number, and those that chance may make the least ones."""

    problem: AdhesiveProblem
    confidence: float
    known: dict[float, Estimate] = field(default_factory=dict)  # by Tabor number

    def fit(self, poisson_ratio: float) -> AdhesionFit:
        """The fit; without a range where the curve does not determine one."""
        best = self._best()
        found, limit = self._under(best), self._under(math.inf)
        chance = (found.widening * found.quantile(self.confidence)) ** 2 / found.noise.freedom
        allowed = _squares(found) * (1 + chance)
        tabor = best if _squares(limit) > allowed else math.inf
        low = self._end(best, allowed, _LEAST_TABOR)
        high = self._end(best, allowed, _LARGEST_TABOR) if tabor < math.inf else math.inf
        numbers = np.geomspace(max(low, _LEAST_TABOR), min(high, _LARGEST_TABOR), _TRIED).tolist()
        numbers += [math.inf] if high == math.inf else []
        ends = [self._ends(self._under(each)) for each in numbers]
        least = np.min([lower for lower, _ in ends], axis=0)
        most = np.max([upper for _, upper in ends], axis=0)
        shown, problem = self._under(tabor), self.problem.with_tabor(tabor)
        modulus, work = np.exp(shown.free[:2]).tolist()
        return AdhesionFit(
            parameters={
                "contact_modulus": modulus,
                "work": work,
                "tabor_number": tabor,
                "range": self._range(tabor),
            },
            intervals={
                "contact_modulus": (math.exp(least[0]), math.exp(most[0])),
                "work": (math.exp(least[1]), math.exp(most[1])),
                "tabor_number": (low, high),
                "range": (self._range(high), self._range(low)),
            },
            confidence=self.confidence,
            contact=self._contact(problem, shown, (float(least[2]), float(most[2]))),
            curve=problem.rows.curve,
            fitted=np.where(problem.rows.fitted, problem.forces(shown.free, 2), np.nan),
            measured=problem.rows.force - problem.scale * (problem.columns @ shown.terms),
            material=Material(
                Elastic(modulus * (1 - poisson_ratio) / 2), poisson_ratio=poisson_ratio
            ),
            units=("Pa", "J/m^2", "", "m"),
            widening=shown.widening,
        )

    def _best(self) -> float:
        """Tabor number of the least squares."""
        numbers = np.geomspace(_LEAST_TABOR, _LARGEST_TABOR, _SCANNED)
        scanned = [_squares(self._under(float(each))) for each in numbers[::-1]][::-1]
        at = int(np.clip(np.argmin(scanned), 1, _SCANNED - 2))
        minimize_scalar(
            lambda log: _squares(self._under(math.exp(log))),
            bounds=np.log(numbers[[at - 1, at + 1]]),
            method="bounded",
            options={"xatol": 2e-3},
        )
        return min(self.known, key=lambda each: _squares(self.known[each]))

    def _under(self, tabor: float) -> Estimate:
        """Least squares under a Tabor number, from the values under the nearest known one."""
        if tabor not in self.known:
            given = [each for each in self.known if math.isfinite(each)]
            start = None
            if given:
                near = min(given, key=lambda each: abs(math.log(each / min(tabor, _LARGEST_TABOR))))
                start = self.known[near].free
            self.known[tabor] = estimated(self.problem.with_tabor(tabor), start)
        return self.known[tabor]

    def _end(self, best: float, allowed: float, farthest: float) -> float:
        """End of the interval of the Tabor number towards one far off; 0 or inf if it is open."""

        def excess(log: float) -> float:
            return _squares(self._under(math.exp(log))) / allowed - 1

        if best == farthest or _squares(self._under(farthest)) <= allowed:
            return 0.0 if farthest < 1 else math.inf
        ends = sorted((math.log(best), math.log(farthest)))
        return math.exp(brentq(excess, *ends, xtol=2e-3))

    def _ends(self, found: Estimate) -> tuple[Floats, Floats]:
        """Lower and upper ends of the logarithms of modulus and work, and of the position [m]."""
        reach = found.quantile(self.confidence) * found.errors[:3]
        low, high = found.free - reach, found.free + reach
        for each in (low, high):
            each[2] = self.problem.position_of(each)
        return low, high

    def _range(self, tabor: float) -> float:
        """Range of a Tabor number [m]."""
        if tabor == 0:
            return math.inf
        modulus, work = np.exp(self._under(tabor).free[:2]).tolist()
        return float(np.cbrt(self.problem.radius * (work / modulus) ** 2)) / tabor

    def _contact(
        self, problem: AdhesiveProblem, found: Estimate, ends: tuple[float, float]
    ) -> FittedContact:
        """Position of the first touch, its interval, and the baseline."""
        quantile, line = found.quantile(self.confidence), found.free.size
        curve, covariance = problem.rows.curve, found.covariance[line:, line:]
        scale = problem.scale / curve.spring_constant
        # The columns are centred: the offset at 0 is that of the rows less the slope to 0.
        turned = scale * np.array([[1.0, -float(curve.position.mean())], [0.0, 1.0]])
        reach = quantile * np.sqrt(np.diag(turned @ covariance @ turned.T))
        slope, offset = problem.rows.line
        values = np.array([offset, slope]) + turned @ found.terms
        low, high = values - reach, values + reach
        names = ("offset", "slope")
        return FittedContact(
            position=problem.position_of(found.free),
            position_interval=ends,
            baseline=dict(zip(names, values.tolist(), strict=True)),
            baseline_intervals={
                name: (float(low[n]), float(high[n])) for n, name in enumerate(names)
            },
        )


def _squares(found: Estimate) -> float:
    return float(found.residuals @ found.residuals)
