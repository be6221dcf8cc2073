"""
Comparison of roller profiles
=============================

The pressure of a cylindrical roller is highest at its ends, that of a crowned roller in the middle.
A logarithmic profile makes the pressure uniform, for one load and one modulus (Lundberg 1939). On a
creeping body the modulus decreases, so the profile must be designed for a given time: here for 1000
s.
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
# Contact at the ends is the subject of this example; the warning about it is switched off.
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
# The figure
# ----------
#
# The pressure on the middle line. At the ends of the cylinder the pressure is infinite: the drawn
# values are means over a cell, which grow as the cells become smaller. The dashed line is the Hertz
# pressure of an infinite cylinder.

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
    axes.set(xlabel="x [mm]", title=f"after {time:g} s", ylim=(0, 140))
panels[0].set_ylabel("pressure [MPa]")
panels[1].legend(frameon=False, loc="upper left", bbox_to_anchor=(1, 1))

# %%
# The check
# ---------
#
# With Lundberg's amplitude F′/(π E*), for a force F′ per length, every section carries the same
# load. The pressure in the middle is then that of a Hertz line contact, p₀ = sqrt(F′ E*/(π R)).

exact = (line_load * modulus / (math.pi * radius)) ** 0.5
crept = runs["logarithmic"].pressure.sel(field_time=1000.0)[:, middle]
ours = float(crept.sel(x=0.0, method="nearest"))
evenness = float(crept.sel(x=slice(-8e-3, 8e-3)).max() / crept.sel(x=slice(-8e-3, 8e-3)).min())

print(f"middle after 1000 s: {ours / 1e6:.2f} MPa, Hertz {exact / 1e6:.2f} MPa")
print(f"largest over least pressure within |x| < 8 mm: {evenness:.3f}")
assert abs(ours / exact - 1) < 5e-3
