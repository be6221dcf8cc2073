"""
Error against resolution
========================

The comparisons of ``viscontact verify`` are run at several resolutions. The error of the approach
(of the half width for a cylinder) is divided by four when the cells are halved, order 2, under
smooth bodies, and by two, order 1, under a flat punch, whose pressure is infinite at the edge.
"""

# %%
# Each case at all its resolutions
# --------------------------------
#
# A case compares the computed values with an exact solution, at one resolution at a time: cells
# along the radius of the contact, or cells per period of a wave.

import warnings

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc
from viscontact.verify import CASES

shown = {
    "sphere": "sphere (Hertz)",
    "cone": "cone (Love, Sneddon)",
    "cylinder, periodic along it": "half width of a cylinder (Hertz)",
    "straight waves, periodic": "waves (Westergaard)",
    "sphere on a creeping layer, ν = 0.3": "sphere on a creeping layer (Fredholm)",
    "flat punch, eccentric": "flat punch, off centre (Sneddon)",
}
# The pressure at the edge of the punch depends on the mesh; the approach does not.
warnings.simplefilter("ignore", vc.AccuracyWarning)
errors = {
    case.name: [case.compare(cells)[0].error for cells in case.levels]
    for case in CASES
    if case.name in shown
}
cells = {case.name: np.array(case.levels) for case in CASES if case.name in shown}

# %%
# Lines of order 1 and 2
# ----------------------

figure, axes = plt.subplots(figsize=(7, 5), layout="constrained")
for name, label in shown.items():
    axes.loglog(cells[name], errors[name], "o-", markersize=4, label=label)
ends = np.array([10.0, 130.0])
axes.loglog(ends, 0.2 / ends**2, color="0.6", linewidth=1, linestyle="--")
axes.loglog(ends, 0.25 / ends, color="0.6", linewidth=1, linestyle="--")
for order, level in ((2, 0.2), (1, 0.25)):
    at_end = (ends[1], level / ends[1] ** order)
    axes.annotate(f"order {order}", at_end, xytext=(4, -3), textcoords="offset points")
axes.set(xlabel="Cells along the radius or the period", ylabel="Relative error")
axes.set_xticks([10, 20, 50, 100], ["10", "20", "50", "100"])
axes.minorticks_off()
axes.spines[["top", "right"]].set_visible(False)
figure.legend(loc="outside lower center", ncols=2, frameon=False)

# %%
# The observed orders
# -------------------

orders = {
    name: -np.polyfit(np.log(cells[name]), np.log(values), 1)[0] for name, values in errors.items()
}
for name, order in orders.items():
    print(f"{name}: {order:.2f}")
punch = orders.pop("flat punch, eccentric")
assert all(abs(order - 2) < 0.15 for order in orders.values())
assert abs(punch - 1) < 0.15
