"""
A creep law from an indentation record
======================================

The inverse problem: an instrument has recorded approach and force, and the creep law is unknown.
Here the record is synthetic, so that the true law is known: it is an exact solution for a known
gel, with 1 % noise added.
"""

# %%
# The record
# ----------
#
# A sphere of 5 µm radius is pressed in within one second, held for three seconds, and withdrawn.
# For your own record, use ``viscontact fit record.csv --indenter "sphere 5 um"``.

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
# The fit gives the parameters with their confidence intervals, and a material that can be used in a
# simulation.

fit = vc.fit_indentation(record, "zener", poisson_ratio=0.5)
for name, value in fit.parameters.items():
    low, high = fit.intervals[name]
    print(f"{name:16} {value:7.1f}  ({low:.1f} to {high:.1f}),  true {getattr(truth, name):g}")

figure = plot.fitted_indentation(fit)

# %%
# The check
# ---------
#
# The confidence intervals contain the true values with a probability of 95 %; for this noise they
# do.

for name, (low, high) in fit.intervals.items():
    assert low < getattr(truth, name) < high, name
assert abs(fit.residual / 0.01 - 1) < 0.15  # the residual is the noise that was added
