"""
Error bars against exact errors
===============================

Every number of a result has an error bar, and a run without a given grid chooses one for a given
tolerance. Here a ball on PMMA is computed with tolerances of 5 %, 1 % and 0.2 %, and the error bars
are compared with the exact solution.
"""

# %%
# Three tolerances
# ----------------

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
# The figure
# ----------
#
# The error of the approach relative to the exact a²/R with a³ = (3/4) R F J(t), with the error
# bands of the runs. Zero, the exact value, lies in each band, or at its edge.

exact = (0.75 * radius * force * pmma.contact_compliance()(times)) ** (2 / 3) / radius

figure, axes = plt.subplots(figsize=(5.4, 3.2), layout="constrained")
for (wish, ds), colour in zip(runs.items(), ["#0072B2", "#D55E00", "#009E73"], strict=True):
    off, bar = ds.approach / exact - 1, ds.approach_error / exact
    label = f"tolerance {wish:.1%}: {int(ds.cells_across[-1])} cells across"
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
axes.set(xscale="log", xlabel="time [s]", ylabel="error of the approach [%]", ylim=(-0.12, 0.04))
axes.legend(frameon=False, fontsize=8, loc="lower left")

# %%
# The check
# ---------
#
# Error bars are meant to hold 95 of 100 true errors: the exact approach lies within them at 50 of
# the 51 instants, and the errors are below the tolerances.

within = []
for wish, ds in runs.items():
    off = np.abs(ds.approach.values - exact)
    print(
        f"tolerance {wish:.1%}: error {np.max(off / exact):.2e}, "
        f"error bar {float(np.max(ds.approach_error / exact)):.2e}"
    )
    within.extend(off <= ds.approach_error.values)
    assert np.max(off / exact) < wish
assert np.mean(within) >= 0.95
