"""Random tests at several temperatures of known shift factors, with 1 to 3 % of noise."""

from __future__ import annotations

import warnings
from dataclasses import dataclass

import numpy as np

from viscontact.identification import Isotherm, MasterCurve, build_master_curve
from viscontact.laws import WLF, Arrhenius, RelaxationSeries

LAWS = ("glass transition", "transition to a rubber", "melt", "rubber")
TESTS = ("oscillation", "relaxation", "creep")


@dataclass(frozen=True, eq=False)
class KnownSets:
    """Sets with the shift factors that they were made with."""

    law: str
    test: str
    exponent: float  # v of b_T = (T/T_r)^v
    isotherms: tuple[Isotherm, ...]
    reference: float
    log_a: np.ndarray  # log10 a_T
    log_b: np.ndarray  # ln b_T

    def joined(self, **options) -> MasterCurve:
        """Master curve; its warnings are in `MasterCurve.warnings`."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return build_master_curve(self.isotherms, self.reference, **options)

    def errors(self, curve: MasterCurve) -> np.ndarray:
        """Errors of log10 a_T [decades]."""
        return np.log10(curve.factors) - self.log_a


def known_sets(seed: int) -> KnownSets:
    """Three to eight temperatures; neighbours share 30 to 75 % of their range."""
    rng = np.random.default_rng(seed)
    law, test = LAWS[rng.integers(4)], TESTS[max(int(rng.integers(5)) - 2, 0)]
    exponent, count = (0.0, 0.3, 1.0)[rng.integers(3)], int(rng.integers(3, 9))
    reference, spacing = rng.uniform(280.0, 420.0), rng.uniform(5.0, 20.0)
    temperatures = reference + spacing * (np.arange(count) - count // 2)
    decades, rows, noise = rng.uniform(2.0, 4.0), int(rng.integers(8, 25)), rng.uniform(0.01, 0.03)
    log_a = _decades(rng, temperatures, reference, rng.uniform(0.25, 0.7) * decades)
    series = _series(rng, law)
    isotherms = []
    for kelvin, shift in zip(temperatures, log_a, strict=True):
        raised, slowed = (kelvin / reference) ** exponent, 10.0**shift
        points = np.geomspace(1.0, 10.0**decades, rows)
        scatter = 1.0 + noise * rng.standard_normal((2, rows))
        if test == "oscillation":
            modulus = raised * series.complex_modulus(points * slowed)
            measured = {"storage": modulus.real * scatter[0], "loss": modulus.imag * scatter[1]}
        elif test == "relaxation":
            measured = {"modulus": raised * series.relaxation(points / slowed) * scatter[0]}
        else:
            measured = {"compliance": series(points / slowed) / raised * scatter[0]}
        isotherms.append(Isotherm(float(kelvin), points, measured))
    log_b = exponent * np.log(temperatures / reference)
    return KnownSets(law, test, exponent, tuple(isotherms), float(reference), log_a, log_b)


def _decades(rng, temperatures, reference, largest_step) -> np.ndarray:
    """Values of log10 a_T by a WLF or an Arrhenius rule, whose largest step is the given one."""
    if rng.random() < 0.5:
        c2 = max(rng.uniform(50.0, 140.0), 20.0 + reference - temperatures[0])
        rule = WLF(float(reference), 10.0, float(c2))
    else:
        rule = Arrhenius(float(reference), 1e5)
    decades = np.log10(rule.factor(temperatures))
    return decades * largest_step / np.max(-np.diff(decades))


def _series(rng, law: str) -> RelaxationSeries:
    """Law with its fast terms within the reach of the tests, whose times begin at 1 s."""
    centre = 10.0 ** rng.uniform(0.0, 2.0)
    if law == "glass transition":
        times = np.geomspace(1e-9, 1e9, 37)
        bell = np.exp(-0.5 * (np.log10(times) / rng.uniform(1.5, 3.0)) ** 2)
        moduli, rest = 1e9 * bell / bell.sum(), 10.0 ** rng.uniform(5.5, 7.0)
    elif law == "transition to a rubber":
        times = np.geomspace(1e-3, 1e2, 6)
        moduli, rest = 1e6 * np.array([30.0, 12.0, 6.0, 3.0, 1.5, 0.8]), 2e6
    elif law == "melt":
        times = np.geomspace(1e-4, 1e3, 7)
        moduli = np.array([3e6, 2e5, 3e4, 3e4, 6e4, 1e5, 2e5])
        rest = 1e3
    else:
        times, moduli, rest = (
            np.geomspace(1e-5, 1e5, 11),
            np.full(11, 10.0 ** rng.uniform(4, 5.3)),
            1e6,
        )
    moduli = moduli * np.exp(0.2 * rng.standard_normal(moduli.size))
    return RelaxationSeries(rest, moduli.tolist(), (centre * times).tolist())
