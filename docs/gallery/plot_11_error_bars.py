"""
How sure is this number?
========================

Every number of a result has its error beside it, and a run without a grid looks for one that
is good enough. Here a ball on PMMA is run three times, asking for 5 %, 1 % and 0.2 %, and the
error bars are held against the exact solution.
"""

# %%
# Asking for an accuracy
# ----------------------

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc

radius, force = 5e-3, 50.0
pmma = vc.shipped_material("pmma-paper")
times = vc.log_times(1.0, 1000.0, 16)

runs = {
    wish: vc.simulate(
        vc.Paraboloid(radius, radius),
        pmma,
        vc.step(force),
        vc.AutomaticGrid(tolerance=wish),
        times,
        fields="none",
    )
    for wish in (0.05, 0.01, 0.002)
}

# %%
# The picture
# -----------
#
# What the approach is off by, from the exact a²/R with a³ = (3/4) R F J(t), in the bands of error
# that the runs state: zero, the truth, lies in each of them.

exact = (0.75 * radius * force * pmma.contact_compliance()(times)) ** (2 / 3) / radius

figure, axes = plt.subplots(figsize=(5.4, 3.2), layout="constrained")
for (wish, ds), colour in zip(runs.items(), ["#0072B2", "#D55E00", "#009E73"], strict=True):
    off, bar = ds.approach / exact - 1, ds.approach_error / exact
    label = f"asked for {wish:.1%}: {int(ds.cells_across[-1])} cells across"
    axes.plot(times[1:], off[1:] * 100, color=colour, label=label)
    axes.fill_between(
        times[1:],
        (off - bar)[1:] * 100,
        (off + bar)[1:] * 100,
        color=colour,
        alpha=0.15,
        linewidth=0,
    )
axes.axhline(0, color="k", linewidth=0.6)
axes.set(
    xscale="log", xlabel="time [s]", ylabel="approach less the exact one [%]", ylim=(-0.12, 0.04)
)
axes.legend(frameon=False, fontsize=8, loc="lower left")

# %%
# The check
# ---------
#
# The exact approach lies within the bars at every instant, and the runs are as close as was asked.

for wish, ds in runs.items():
    off = np.abs(ds.approach.values - exact)
    print(
        f"{wish:.1%} wanted: off by {np.max(off / exact):.2e}, "
        f"bar {float(np.max(ds.approach_error / exact)):.2e}"
    )
    assert np.all(off <= ds.approach_error.values)
    assert np.max(off / exact) < wish
