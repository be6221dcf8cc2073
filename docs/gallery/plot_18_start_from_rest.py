"""
Cylinder accelerated from rest
==============================

A rigid cylinder is pressed on a viscoelastic half-space and starts suddenly at a constant speed.
The contact is left behind until it has formed anew under the moving cylinder, and the friction
coefficient settles to that of steady motion, Hunter's exact solution (1961).
"""

# %%
# Two speeds
# ----------
#
# The grid belongs to the surface and holds the whole path: eight times the way in the retardation
# time. It is periodic along the cylinder, with one cell there. Without given times the steps are a
# cell of way each, so that the cylinder lies alike within the cells in all of them.

import math
import warnings

import matplotlib.pyplot as plt

import viscontact as vc

radius, load, lane = 10e-3, 10e3, 1e-3  # m, N/m, m
instant, delayed, time = (
    5e-10,
    4.5e-9,
    10.0,
)  # contact compliance J0 + J1 (1 - exp(-t/time)) in 1/Pa
rubber = vc.Material(vc.CreepSeries(2 * instant, [2 * delayed], [time]), poisson_ratio=0.5)

steady, runs = {}, {}
for speed in (2e-5, 1e-4):
    line = vc.reference.moving_cylinder(load, radius, instant, delayed, time, speed)
    cell = line.half_width / 20
    way = math.ceil(8 * speed * time / cell) * cell
    across = round((way + 6 * line.half_width) / cell)
    grid = vc.Grid(
        (1, across), (lane, across * cell), periodic=(True, False), centre=(0.0, way / 2)
    )
    with warnings.catch_warnings():  # a line contact on a half-space has no approach
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        runs[speed] = vc.simulate(
            vc.Paraboloid(math.inf, radius),
            rubber,
            vc.step(load * lane, tilt_y=0.0),
            grid,
            motion=vc.Travel([0.0, way / speed], y=[0.0, way]),
            fields="none",
            errors=False,
        )
    steady[speed] = line.friction_coefficient

# %%
# The figure
# ----------
#
# The distance is divided by that during the retardation time: the start is forgotten after six.

figure, axes = plt.subplots(figsize=(4.8, 3.4), layout="constrained")
for (speed, ds), colour in zip(runs.items(), ["#0072B2", "#D55E00"], strict=True):
    moved = ds.position_y / (speed * time)
    axes.plot(moved, ds.friction_coefficient, color=colour, label=f"{speed * 1e3:g} mm/s")
    axes.axhline(steady[speed], color=colour, linestyle=":", linewidth=1.0)
axes.set(xlabel="distance / (speed × retardation time)", ylabel="friction coefficient")
axes.set_ylim(bottom=0.0)
axes.legend(frameon=False, title="speed (dotted: steady)")

# %%
# The check
# ---------

for speed, ds in runs.items():
    last = float(ds.friction_coefficient[-1])
    print(f"{speed * 1e3:g} mm/s: {last:.5f}, in steady motion {steady[speed]:.5f}")
    assert abs(last / steady[speed] - 1) < 3e-3
