"""
A creep law from an indentation record
======================================

The way back: an instrument has written down approach and force, and the law is wanted. Here the
record is made up, so that the truth is known: an exact solution for a known gel, with 1 % of
scatter added.
"""

# %%
# The record
# ----------
#
# A sphere of 5 µm radius is pressed in within a second, held for three, and drawn back. One's own
# would come from a CSV, ``viscontact fit record.csv --indenter "sphere 5 um"``.

import numpy as np

import viscontact as vc
from viscontact import plot, reference

truth = vc.Zener(shear_modulus=1000.0, delayed_modulus=800.0, viscosity=600.0)

times = np.linspace(0.0, 5.0, 201)
approach = np.interp(times, [0.0, 1.0, 4.0, 5.0], [0.0, 400e-9, 400e-9, 0.0])
exact = reference.press_axisymmetric(
    reference.SphereProfile(5e-6),
    times,
    approach=approach,
    creep_compliance=vc.Material(truth, poisson_ratio=0.5).contact_compliance(),
)
scatter = 0.01 * exact.force.max() * np.random.default_rng(1).standard_normal(times.size)
record = vc.IndentationRecord(vc.Sphere(5e-6), times, approach, exact.force + scatter)

# %%
# The fit
# -------
#
# It gives the parameters with their confidence intervals, and a material that can be computed
# with at once.

fit = vc.fit_indentation(record, "zener", poisson_ratio=0.5)
for name, value in fit.parameters.items():
    low, high = fit.intervals[name]
    print(f"{name:16} {value:7.1f}  ({low:.1f} to {high:.1f}),  true {getattr(truth, name):g}")

figure = plot.fitted_indentation(fit)

# %%
# The check
# ---------
#
# The intervals are made to hold the truth 95 times of 100; with this scatter they do.

for name, (low, high) in fit.intervals.items():
    assert low < getattr(truth, name) < high, name
assert abs(fit.residual / 0.01 - 1) < 0.15  # what is left over is the scatter that was put in
