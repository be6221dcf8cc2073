"""
Reciprocating motion of a pad
=============================

A round pad slides back and forth on rubber without friction. The resistance over the position is a
loop, whose area is lost as heat in each cycle.
"""

# %%
# Two periods
# -----------
#
# The amplitude is about the radius of the contact. The body moves by a cell a step at most, less
# near the turning points.

import warnings

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc

law = vc.Zener(shear_modulus=9e6, delayed_modulus=1e6, viscosity=1e6)  # retardation time 1 s
rubber = vc.Material(law, poisson_ratio=0.5)
pad = vc.Paraboloid(20e-3, 20e-3)
held = vc.step(2.0, tilt_x=0.0, tilt_y=0.0)
grid = vc.Grid((36, 56), (7.2e-3, 11.2e-3))
# The force is applied instantly and then held: the first steps are long against the law.
warnings.simplefilter("ignore", vc.AccuracyWarning)

runs = {
    period: vc.simulate(
        pad,
        rubber,
        held,
        grid,
        motion=vc.reciprocating(1.5e-3, period, cycles=3),
        fields="none",
        errors=False,
    )
    for period in (2.0, 20.0)
}

# %%
# The figure
# ----------
#
# The last cycle of each run. The pad is held back where resistance and velocity have the same sign.

figure, axes = plt.subplots(figsize=(4.8, 3.4), layout="constrained")
for (period, ds), colour in zip(runs.items(), ["#0072B2", "#D55E00"], strict=True):
    last = ds.sel(time=slice(2 * period * (1 - 1e-9), None))
    lost = float(ds.loss_per_cycle[-1])
    axes.plot(
        last.position_y * 1e3,
        last.resistance_y * 1e3,
        color=colour,
        label=f"{period:g} s: {lost * 1e6:.1f} µJ",
    )
axes.set(xlabel="position [mm]", ylabel="resistance [mN]")
axes.legend(frameon=False, title="period: loss per cycle")

# %%
# The check
# ---------
#
# What the motion and the load do in a cycle has become heat when the cycle repeats itself.

for period, ds in runs.items():
    cycle = ds.sel(time=[2 * period, 3 * period], method="nearest")
    heat = float(np.diff(cycle.heat)[0])
    lost = float(ds.loss_per_cycle[-1])
    print(f"period {period:g} s: {lost * 1e6:.2f} µJ are lost, the heat is {heat * 1e6:.2f} µJ")
    assert abs(heat / lost - 1) < 0.02
