"""
The paper's rollers, on and off centre
======================================

A steel roller with rounded ends is pressed on PMMA with 10 kN. The load acts in the middle, halfway
to the end of the straight part, and at this end. Shape, load and creep law are those of Spinu &
Cerlinca (2018), except for the crown: its radius is 75 mm here, as their figures suggest, instead
of the printed 7500 mm.
"""

# %%
# Three runs
# ----------
#
# The creep law is eq. 15 of the paper; ``viscontact material pmma-paper`` gives its source. The
# grids are coarser than those of the shipped cases (``viscontact example roller-dogbone``), so that
# each run takes about a second.

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc
from viscontact import plot

straight = 9.565e-3  # half of the straight part [m]
roller = vc.Roller(radius=5e-3, half_length=straight, crown_radius=75e-3)
pmma = vc.shipped_material("pmma-paper")
grid = vc.Grid((192, 64), (48e-3, 3.2e-3))
times = vc.log_times(1.0, 1000.0, 24)

runs = {
    f"e/L = {ratio:g}": vc.simulate(
        roller, pmma, vc.step(10e3, eccentricity_x=ratio * straight), grid, times, fields=[0, 1000]
    )
    for ratio in (0.0, 0.5, 1.0)
}

# %%
# The figures
# -----------
#
# The pressure on the middle line, just after loading and after 1000 s. It has peaks where the crown
# begins. With an eccentric load, the peak near the load is higher and the other one is lower.

figure, panels = plt.subplots(1, 3, figsize=(7.2, 2.6), sharey=True, layout="constrained")
middle = len(grid.y) // 2
for axes, (name, ds) in zip(panels, runs.items(), strict=True):
    for time, colour in ((0.0, "#440154"), (1000.0, "#d98c00")):
        pressure = ds.pressure.sel(field_time=time)[:, middle]
        axes.plot(ds.x * 1e3, pressure / 1e6, color=colour, label=f"{time:g} s")
    axes.set(xlabel="x [mm]", title=name, xlim=(-22, 22), ylim=(0, 400))
panels[0].set_ylabel("pressure [MPa]")
panels[0].legend(frameon=False, loc="upper left")

# %%
# Contours of pressure for the load halfway off centre: an asymmetric dog-bone shape.

figure = plot.pressure_map(runs["e/L = 0.5"])

# %%
# The check
# ---------
#
# While a contact grows under a constant force, approach and tilt of a creeping body are those of an
# elastic body with the current creep compliance (Lee & Radok 1960). So one elastic step must give
# the approach and the tilt of the run with 24 steps. Φ(1000 s) is eq. 15 of the paper.

phi = 7e-10 - 6.17e-11 * np.exp(-0.1 * 1000) - 8.38e-11 * np.exp(-7.47e-3 * 1000)
elastic = vc.Material(vc.Elastic(1 / (2 * phi)), poisson_ratio=0.38)
load = vc.step(10e3, eccentricity_x=straight)
elastic_ds = vc.simulate(roller, elastic, load, grid, [0.0], fields="none", errors=False)

crept = runs["e/L = 1"]
for name in ("approach", "tilt_x"):
    ours, theirs = float(crept[name][-1]), float(elastic_ds[name][0])
    unit = crept[name].attrs["units"]
    print(f"{name} after 1000 s: {ours:.6g} {unit}, elastic body {theirs:.6g} {unit}")
    assert abs(ours / theirs - 1) < 1e-4

# As in the paper, the tilt increases and the approach decreases with the eccentricity.
assert np.all(np.diff([float(ds.tilt_x[-1]) for ds in runs.values()]) > 0)
assert np.all(np.diff([float(ds.approach[-1]) for ds in runs.values()]) < 0)
# sphinx_gallery_thumbnail_number = 2
