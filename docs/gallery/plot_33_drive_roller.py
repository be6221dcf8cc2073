"""
Traction of a drive roller
==========================

The surface of a roller that drives is a little faster than its travel: by the creepage. At the
leading edge rubber sticks to it, and is stretched until it slips at the trailing one.
``vc.steady`` solves for the traction at each creepage and speed.
"""

# %%
# Traction over creepage
# ----------------------
#
# The roller is a line contact, whose grid the run chooses. Fast motion stiffens the rubber, so that
# the contact is shorter, and less creepage lets all of it slip.

import math
import warnings

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc

radius, line_load, friction = 30e-3, 1000.0, 0.5  # m, N/m
rubber = vc.Material(vc.Zener(2e6, 1e6, 1e5), poisson_ratio=0.5)
# A line contact on a half-space has no approach, of which a warning tells.
warnings.simplefilter("ignore", vc.AccuracyWarning)

ds = vc.steady(
    vc.Paraboloid(math.inf, radius),
    rubber,
    vc.step(line_load, tilt_y=0.0),
    [0.003, 0.03, 1000.0],
    grid=vc.Grid((1, 160), (1.0, 14e-3), periodic=(True, False)),
    friction=friction,
    creepage=np.linspace(0.0, 0.06, 13),
)
figure = vc.plot.traction_creepage(ds)

# %%
# Tractions under the roller
# --------------------------
#
# It travels to the right. The traction follows friction times pressure, dotted, behind the stick
# zone.

figure, axes = plt.subplots(figsize=(4.8, 3.2), layout="constrained")
for creepage, colour in ((0.01, "#440154"), (0.03, "#287d8e"), (0.05, "#8fd744")):
    here = ds.sel(speed=0.03, creepage=creepage, method="nearest").isel(x=0)
    axes.plot(1e3 * ds.y, -1e-3 * here.traction_y, color=colour, label=f"{creepage:.0%}")
axes.plot(1e3 * ds.y, 1e-3 * friction * here.pressure, ":", color="gray")
axes.set(xlabel="y from the axis [mm]", ylabel="Traction backwards [kPa]", xlim=(-5, 5))
axes.legend(title="Creepage", frameon=False)

# %%
# Where the work goes
# -------------------
#
# Of the work of the drive against the traction a part is heat between the surfaces, the rest is
# lost in the rubber.

shown = ds.sel(speed=0.03)
figure, axes = plt.subplots(figsize=(4.8, 3.2), layout="constrained")
axes.stackplot(
    100 * ds.creepage,
    shown.friction_power,
    shown.traction_dissipation,
    labels=("heat of friction", "loss in the rubber"),
    colors=("#d98c00", "#287d8e"),
)
put_in = -shown.tangential_force_y * ds.creepage * 0.03
axes.plot(100 * ds.creepage, put_in, "k--", label="traction times slip of the roller")
axes.set(xlabel="Creepage [%]", ylabel="Power per length [W/m]", xlim=(0, 6), ylim=(0, None))
axes.legend(frameon=False, loc="upper left")

# %%
# The check
# ---------
#
# In fast motion the rubber is elastic, and Carter's (1926) solution is exact.

compliance = 0.25 / 2e6  # (1 - ν)/(2 G)
half_width = math.sqrt(4 * line_load * radius * compliance / math.pi)
part = np.minimum(ds.creepage * radius / (friction * half_width), 1.0)
exact = friction * line_load * (1 - (1 - part) ** 2)
found = -ds.tangential_force_y.sel(speed=1000.0)
error = float(np.abs(found / exact - 1)[1:].max())
lost = float(np.abs((shown.friction_power + shown.traction_dissipation) / put_in - 1)[1:].max())

print(f"largest difference from Carter: {error:.1e}; of the balance of power: {lost:.1e}")
assert error < 2e-3
assert lost < 5e-3  # at the smallest creepage few cells slip
