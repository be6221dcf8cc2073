"""
Crown study: the best radius at 0 s and after 1000 s
====================================================

The roller of Spinu & Cerlinca (2018) on PMMA under 10 kN, here with a total length of 30 mm: its
crown ends in a sharp edge. A larger crown radius spreads the load, until the contact reaches that
edge. The load acts in the middle, or off centre by up to half of the half length L = 9.565 mm.
"""

# %%
# All radii
# ---------
#
# Each run goes to 1000 s. A contact that reaches the edge is not a candidate: pressure has no limit
# there, and the peak of the run is only what its cells resolve.

import tempfile
import warnings
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc

warnings.simplefilter("ignore", vc.AccuracyWarning)  # the ends are the subject of this example
half_length, end = 9.565e-3, 15e-3
pmma, grid = vc.shipped_material("pmma-paper"), vc.Grid((192, 64), (30.6e-3, 4e-3))
radii, ratios = np.geomspace(15e-3, 120e-3, 25), (0.0, 0.25, 0.5)
colours = ("#009E73", "#D55E00", "#0072B2")
peaks = np.empty((2, len(ratios), len(radii)))  # at 0 s and at 1000 s [MPa]
is_clear = np.empty(peaks.shape, dtype=bool)  # of the ends
last_cells = (abs(grid.x) < end) & (abs(grid.x) > end - 1.5 * grid.cell_size[0])

for row, ratio in enumerate(ratios):
    load = vc.step(10e3, eccentricity_x=ratio * half_length)
    for column, radius in enumerate(radii):
        profile = vc.PartialCrown(radius, end_length=end)
        roller = vc.Roller(5e-3, half_length, profile=profile)
        ds = vc.simulate(roller, pmma, load, grid, [0.0, 1.0, 30.0, 1000.0], errors=False)
        for instant in (0, -1):
            peaks[instant, row, column] = ds.peak_pressure[instant] / 1e6
            is_clear[instant, row, column] = not ds.pressure[instant, last_cells].any()

# %%
# The figure
# ----------
#
# Crosses are contacts at the edge. The best radius is the largest one without a cross. As the
# polymer creeps, the contact grows: the radius that is best just after loading is too large later.

figure, panels = plt.subplots(1, 2, figsize=(7.2, 3.2), sharey=True, layout="constrained")
for instant, (axes, name) in enumerate(zip(panels, ("0 s", "1000 s"), strict=True)):
    for row, (ratio, colour) in enumerate(zip(ratios, colours, strict=True)):
        values, clear = peaks[instant, row], is_clear[instant, row]
        best = np.where(clear, values, np.inf).argmin()
        axes.plot(radii[clear] * 1e3, values[clear], color=colour, label=f"e/L = {ratio:g}")
        axes.plot(radii[~clear] * 1e3, values[~clear], "x", color=colour, alpha=0.5, markersize=4)
        axes.plot(radii[best] * 1e3, values[best], "s", markerfacecolor="none", color=colour)
        print(f"{name}, e/L = {ratio:g}: {radii[best] * 1e3:.0f} mm, {values[best]:.0f} MPa")
    axes.set(xlabel="crown radius [mm]", title=f"at {name}", xscale="log", ylim=(200, 700))
    axes.set_xticks([15, 30, 60, 120], labels=["15", "30", "60", "120"], minor=False)
    axes.minorticks_off()
panels[0].set_ylabel("peak pressure [MPa]")
panels[0].legend(frameon=False, loc="upper left")

# %%
# The search
# ----------
#
# ``vc.design`` finds the radius that is best for all three loads, at every instant up to 1000 s,
# with a contact that is clear of the ends, and states what is gained under each of them.

CASE = """
indenter: {shape: roller, radius: 5 mm, half_length: 9.565 mm, crown_radius: 20 mm, length: 30 mm}
material: pmma-paper
load: {kind: step, force: 10 kN}
time: {end: 1000 s, steps: 3, spacing: log, first: 1 s}
grid: {shape: [192, 64], size: [30.6 mm, 4 mm]}
"""
file = Path(tempfile.mkdtemp(), "roller.yaml")
file.write_text(CASE, encoding="utf-8")
found = vc.design(
    file,
    {"indenter.crown_radius": ("15 mm", "120 mm", "log")},
    minimise="peak_pressure",
    over={"load.eccentricity_x": ["0 mm", "2.39 mm", "4.78 mm"]},
    clear_of_ends=True,
    workers=1,
)
print(found)
before, after = (
    found.table.peak_pressure_of_scenarios.isel(trial=trial) for trial in (0, found.number)
)
for name, gain in zip(found.table.scenario.values, 1 - after.values / before.values, strict=True):
    print(f"{name}: {gain:.1%} lower than with 20 mm")

# %%
# The check: no radius of the scan is better, within the step of the scan. The worst load is the one
# farthest off centre, and a candidate must be clear of the ends at both instants.

candidates = np.where(is_clear.all(axis=(0, 1)), peaks.max(axis=(0, 1)), np.inf)
ours = float(found.best.peak_pressure) / 1e6
print(f"design {ours:.1f} MPa, scan {candidates.min():.1f} MPa")
assert abs(ours / candidates.min() - 1) < 0.02
