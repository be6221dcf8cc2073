"""
Rolling friction over speed
===========================

A cylinder rolls on rubber with one retardation time. The friction coefficient rises in proportion
to the speed, has a maximum where the contact is passed in about the retardation time, and falls
again. ``vc.steady`` solves for the steady state at each speed; Hunter's exact solution (1961) is
the check.
"""

# %%
# A line contact
# --------------
#
# The cylinder has no end: its grid is periodic along it, with a single cell. The contact lies ahead
# of the axis, by an amount that depends on the speed; the exact solution gives the region of the
# grid here. (A sphere or a crowned roller needs no grid.)

import warnings

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc

radius, load = 20e-3, 1000.0  # m, N/m
instant, delayed, time = 1e-7, 9e-7, 1.0  # contact compliance J0 + J1 (1 - exp(-t/time)) in 1/Pa
rubber = vc.Material(vc.CreepSeries(2 * instant, [2 * delayed], [time]), poisson_ratio=0.5)
speeds = np.geomspace(1e-4, 1.0, 9)

exact, found = [], []
for speed in speeds:
    line = vc.reference.moving_cylinder(load, radius, instant, delayed, time, speed)
    size = (1.0, 2.6 * line.half_width)
    grid = vc.Grid((1, 168), size, periodic=(True, False), centre=(0.0, line.offset))
    with warnings.catch_warnings():  # a line contact on a half-space has no approach
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        ds = vc.steady(
            vc.Paraboloid(np.inf, radius), rubber, vc.step(load, tilt_y=0.0), speed, grid=grid
        )
    exact.append(line.friction_coefficient)
    found.append(float(ds.friction_coefficient[0]))

figure, axes = plt.subplots(figsize=(4.8, 3.4), layout="constrained")
between = np.geomspace(1e-4, 1.0, 80)
lines = [
    vc.reference.moving_cylinder(load, radius, instant, delayed, time, speed) for speed in between
]
curve = [line.friction_coefficient for line in lines]
axes.loglog(between, curve, "-", color="#d98c00", label="Hunter 1961")
axes.loglog(speeds, found, "o", color="#440154", markersize=4, label="viscontact")
slow = vc.reference.slow_friction_coefficient(radius, time * delayed / (instant + delayed), 1.0)
axes.loglog(speeds[:6], slow * speeds[:6], "--", color="gray", label="limit of slow motion")
axes.set(xlabel="speed [m/s]", ylabel="friction coefficient", ylim=(5e-4, 0.2))
axes.legend(frameon=False)

# %%
# The check
# ---------

errors = np.abs(np.array(found) / np.array(exact) - 1)
print(f"largest error: {errors.max():.1e}, at {speeds[errors.argmax()]:g} m/s")
assert errors.max() < 2e-3
