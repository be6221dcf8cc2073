"""
Rubber-covered roll in a nip
============================

A steel roll with a rubber cover rolls on a flat steel bed. The loss in the cover resists the
motion. With the speed the rubber stiffens: the nip becomes narrower and the peak pressure higher,
and the resistance has a maximum where the nip is passed in about the retardation times. A thinner
cover has a narrower nip, and less resistance.
"""

# %%
# Three covers, a curve of speeds
# -------------------------------
#
# The rubber relaxes to a quarter of its modulus, with two retardation times. A roll is long: a line
# contact of one metre is computed, with a single cell along the roll. ``rolling=True``: the cover
# passes through the nip, and returns after each turn.

import warnings

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc

radius, load = 60e-3, 4000.0  # m, N/m
instant, delayed, times = (
    1e-7,
    [1.5e-7, 1.5e-7],
    [1e-3, 1e-2],
)  # strain per stress deviator, 1/Pa; s
rubber = vc.Material(vc.CreepSeries(instant, delayed, times), poisson_ratio=0.49)
steel = vc.Material(vc.Elastic(80e9), poisson_ratio=0.3)
roll, on_axle = vc.Paraboloid(np.inf, radius), vc.step(load, tilt_y=0.0)
speeds = np.geomspace(4e-3, 40.0, 17)

runs = {}
for thickness in (12e-3, 6e-3, 3e-3):
    cover = vc.Layered([vc.Layer(thickness, rubber)], base=steel)
    grid = vc.Grid((1, 360), (1.0, 24e-3), periodic=(True, False))
    with warnings.catch_warnings():  # a line contact on a deep body has no approach
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        runs[thickness] = vc.steady(
            roll, steel, on_axle, speeds, grid=grid, indenter_material=cover, rolling=True
        )

# %%
# The figure
# ----------

figure, axes = plt.subplots(1, 3, figsize=(7.2, 2.9), layout="constrained")
panels = (
    ("friction_coefficient", 1.0, "friction coefficient"),
    ("contact_width", 1e3, "width of the nip [mm]"),
    ("peak_pressure", 1e-6, "peak pressure [MPa]"),
)
for (thickness, ds), colour in zip(runs.items(), ("#440154", "#21918c", "#d98c00"), strict=True):
    for axis, (name, unit, label) in zip(axes, panels, strict=True):
        axis.semilogx(speeds, ds[name] * unit, color=colour, label=f"{thickness * 1e3:g} mm")
        axis.set(xlabel="speed [m/s]", ylabel=label)
for axis in axes:
    axis.set_ylim(0, None)
axes[1].legend(title="cover", frameon=False, loc="lower left")

# %%
# The check
# ---------
#
# In slow motion the surface is late by one time, whatever the thickness of the cover: the friction
# coefficient is the way passed in it over the radius. At the slowest speed the limit is not quite
# reached: the deviation falls in proportion to the speed.

lag = float(np.dot(delayed, times)) / (instant + sum(delayed))
slow = vc.reference.slow_friction_coefficient(radius, lag, speeds[0])
for thickness, ds in runs.items():
    found, bar = (
        float(ds[name][0]) for name in ("friction_coefficient", "friction_coefficient_error")
    )
    print(
        f"cover {thickness * 1e3:4.0f} mm: {found:.2e} ± {bar:.0e}, limit of slow motion {slow:.2e}"
    )
    assert abs(found / slow - 1) < 0.02
