"""
Master curve from tests at several temperatures
===============================================

A rheometer covers four decades of frequency, but a component may be loaded for years. Tests at
several temperatures, shifted along the time axis, give one curve over a long enough range
(time-temperature superposition). A Prony series fitted to this curve is a law for simulations.
"""

# %%
# The tests
# ---------
#
# Storage and loss modulus at nine temperatures, with 1 % noise. The data are synthetic, from a law
# with a wide glass transition and a WLF rule, so that the true values are known. For your own data,
# use a CSV file with a temperature column: ``viscontact fit dma.csv``.

import numpy as np

import viscontact as vc
from viscontact import plot

rule = vc.WLF(reference_temperature=373.15, c1=12.0, c2=60.0)
taus = np.geomspace(1e-10, 1e10, 41)
weights = np.exp(-0.5 * (np.log10(taus) / 2.5) ** 2)
truth = vc.RelaxationSeries(2e6, list(800e6 * weights / weights.sum()), list(taus))

temperatures = 273.15 + np.array([90.0, 94.0, 98.0, 102.0, 106.0, 110.0, 115.0, 120.0, 125.0])
omega = np.geomspace(0.1, 1000.0, 17)
rng = np.random.default_rng(4)
isotherms = []
for temperature in temperatures:
    modulus = truth.complex_modulus(omega * rule.factor(temperature))
    scatter = 1 + 0.01 * rng.standard_normal((2, omega.size))
    measured = {"storage": modulus.real * scatter[0], "loss": modulus.imag * scatter[1]}
    isotherms.append(vc.Isotherm(temperature, omega, measured))

# %%
# The master curve and its law
# ----------------------------

curve = vc.build_master_curve(isotherms, reference_temperature=373.15)
fit = vc.fit_master_curve(curve, data="shear")
wlf = curve.fit_wlf()
print(f"{fit.terms} terms, residual {fit.residual:.1%}")

figure = plot.master_curve(curve, fit=fit, rules=[wlf])

# %%
# The check
# ---------
#
# The identified shift factors agree with the true ones to a fiftieth of a decade over six decades.

found, true = np.log10(curve.factors), np.log10(rule.factor(temperatures))
worst = float(np.abs(found - true).max())
print(f"shift factors over {np.ptp(true):.1f} decades, largest error {worst:.3f} decades")
assert worst < 0.05

# The fitted law is accurate over the fitted range.
check = np.geomspace(1e-3, 1e3, 13)
off = float(np.abs(fit.law.relaxation(check) / truth.relaxation(check) - 1).max())
print(f"relaxation modulus between 1 ms and 1000 s, largest error {off:.1%}")
assert off < 0.01
