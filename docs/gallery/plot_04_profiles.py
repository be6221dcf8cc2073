"""
Which profile should a roller have?
===================================

A straight roller presses hardest at its ends, a round crown in its middle. A logarithmic profile
evens the pressure out, for one load and one modulus (Lundberg 1939). On a body that creeps the
modulus falls, so one has to say for when: here the profile is designed for 1000 s.
"""

# %%
# Three profiles under one load
# -----------------------------

import math
import warnings

import matplotlib.pyplot as plt

import viscontact as vc
from viscontact import reference

radius, half_length, force = 5e-3, 9.565e-3, 1e3
pmma = vc.shipped_material("pmma-paper")
modulus = 1 / float(pmma.contact_compliance()(1000.0))  # E* after 1000 s
line_load = force / (2 * half_length)

profiles = {
    "cylindrical": vc.CylindricalProfile(),
    "crowned": vc.FullCrown(crown_radius=0.6),
    "logarithmic": vc.LogarithmicProfile(line_load / (math.pi * modulus), end_drop=30e-6),
}
grid = vc.Grid((192, 40), (20e-3, 1.1e-3))
# Contact at the ends is what is studied here; a run warns of it.
warnings.simplefilter("ignore", vc.AccuracyWarning)
runs = {
    name: vc.simulate(
        vc.Roller(radius, half_length, profile=profile),
        pmma,
        vc.step(force),
        grid,
        vc.log_times(1.0, 1000.0, 12),
        fields=[0.0, 1000.0],
    )
    for name, profile in profiles.items()
}

# %%
# The picture
# -----------
#
# The pressure on the middle line. At the ends of the cylinder it has no limit: what is drawn there
# is a mean over a cell, and grows with finer ones. The dashed line is Hertz's for a cylinder
# without ends.

figure, panels = plt.subplots(1, 2, figsize=(7.2, 3.0), sharey=True, layout="constrained")
middle = len(grid.y) // 2
for axes, time in zip(panels, (0.0, 1000.0), strict=True):
    for (name, ds), colour in zip(runs.items(), ["#0072B2", "#D55E00", "#009E73"], strict=True):
        pressure = ds.pressure.sel(field_time=time)[:, middle]
        axes.plot(ds.x * 1e3, pressure / 1e6, color=colour, label=name)
    here = 1 / float(pmma.contact_compliance()(time))
    hertz = reference.hertz_line(line_load, radius, here)
    even = {"color": "k", "linestyle": "--", "linewidth": 0.8, "label": "even (Hertz)"}
    axes.axhline(hertz.peak_pressure / 1e6, **even)
    axes.set(xlabel="x [mm]", title=f"after {time:g} s" if time else "at once", ylim=(0, 140))
panels[0].set_ylabel("pressure [MPa]")
panels[1].legend(frameon=False, loc="upper left", bbox_to_anchor=(1, 1))

# %%
# The check
# ---------
#
# Lundberg's amplitude F′/(π E*), for a force F′ per length, is made so that every section bears the
# same: the middle then has Hertz's pressure of a line contact, p₀ = sqrt(F′ E*/(π R)).

exact = (line_load * modulus / (math.pi * radius)) ** 0.5
crept = runs["logarithmic"].pressure.sel(field_time=1000.0)[:, middle]
ours = float(crept.sel(x=0.0, method="nearest"))
evenness = float(crept.sel(x=slice(-8e-3, 8e-3)).max() / crept.sel(x=slice(-8e-3, 8e-3)).min())

print(f"middle after 1000 s: {ours / 1e6:.2f} MPa, Hertz {exact / 1e6:.2f} MPa")
print(f"largest over least pressure within |x| < 8 mm: {evenness:.3f}")
assert abs(ours / exact - 1) < 5e-3
