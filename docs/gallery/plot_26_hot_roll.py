"""
Self-heating of a covered roll
==============================

The loss in its cover heats a roll. Where the loss grows with the temperature, there are two
balances of power and cooling at moderate speeds, one of them unstable, and none above the speed of
thermal runaway. A curve over speed at one temperature is enough to find them: at another
temperature it is passed at the speed times the shift factor.
"""

# %%
# A curve over speed
# ------------------
#
# The cover is a hard polymer below its glass transition, a line contact of one metre. The shift is
# that of Arrhenius. The slowest speeds are those of the hot roll, multiplied by its small factor.

import warnings

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc

law = vc.FractionalZener(1.6e9, 15e6, time=100.0, exponent=0.3)
shift = vc.Arrhenius(333.15, 250e3)
polymer = vc.Material(law, bulk_modulus=5e9, shift=shift)
steel = vc.Material(vc.Elastic(80e9), poisson_ratio=0.3)
cover = vc.Layered([vc.Layer(12e-3, polymer)], base=steel)
roll, on_axle = vc.Paraboloid(np.inf, 0.25), vc.step(250e3, tilt_y=0.0)
speeds = np.geomspace(1e-4, 100.0, 19)
grid = vc.Grid((1, 256), (1.0, 24e-3), periodic=(True, False))

with warnings.catch_warnings():  # a line contact has no approach
    warnings.simplefilter("ignore", vc.AccuracyWarning)
    curve = vc.steady(
        roll,
        steel,
        on_axle,
        speeds,
        grid=grid,
        indenter_material=cover,
        rolling=True,
        fields="none",
        errors=False,
    )

# %%
# Temperatures for three coefficients of cooling
# ----------------------------------------------
#
# Hotter balances than these are beyond the curve, which a warning says.

found = {}
for cooling in (20.0, 40.0, 60.0):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        found[cooling] = vc.rolling_temperature(
            curve, cooling=cooling, ambient=333.15, conductivity=0.3, speed=np.linspace(1, 16, 16)
        )

# %%
# The figure
# ----------

figure, axes = plt.subplots(figsize=(5.0, 3.4), layout="constrained")
for (cooling, heat), colour in zip(found.items(), ("#440154", "#21918c", "#d98c00"), strict=True):
    table = heat.table
    celsius = table.at_temperature - 273.15
    for stable, dashes in ((True, "-"), (False, "--")):
        speed = table.speed_at.where(table.stable_at == stable)
        label = f"{cooling:g} W/(m² K)" if stable else None
        axes.plot(speed, celsius, color=colour, linestyle=dashes, label=label)
    axes.plot(heat.runaway_speed, table.runaway_temperature - 273.15, "o", color=colour)
axes.set(xlabel="speed [m/s]", ylabel="temperature [°C]", xlim=(0, 16), ylim=(58, 112))
axes.legend(title="cooling", frameon=False)

# %%
# The check
# ---------
#
# Where power and cooling touch, d ln P/dT = 1/(T - T_0), the condition of Semenov (1928). With the
# power P = V R(V a_T) the rise above the air is 1/(n b), with b = -d ln a_T/dT, and with
# n = -d ln R/d ln V from the curve, between the speeds on both sides.

for cooling, heat in found.items():
    temperature = heat.table.runaway_temperature
    scaled = heat.runaway_speed * shift.factor(temperature)
    near = np.searchsorted(speeds, scaled) + np.array([-1, 0])
    exponent = -np.diff(np.log(curve.resistance_y[near])) / np.diff(np.log(speeds[near]))
    slope = 250e3 / 8.314462618 / temperature**2
    semenov = 1 / float(exponent[0] * slope)
    rise = temperature - 333.15
    print(
        f"{cooling:2g} W/(m² K): runaway at {heat.runaway_speed:5.2f} m/s, "
        f"{rise:.2f} K above the air; Semenov {semenov:.2f} K"
    )
    assert abs(rise / semenov - 1) < 0.03
