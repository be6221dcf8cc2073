"""
Sphere on a Zener half-space
============================

The same ball on a Zener body (a spring in series with a Kelvin unit): Fig. 7 of Spinu & Cerlinca
(2018). Creep ends when the delayed spring is fully deformed. The pressure changes from one Hertz
distribution to another with a lower peak.
"""

# %%
# The case
# --------
#
# Both springs are equal, so the compliance finally doubles. The retardation time is
# viscosity/delayed modulus = 1 s, so creep ends within seconds.

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc
from viscontact import reference

radius, force = 10e-3, 4.0
law = vc.Zener(shear_modulus=10e6, delayed_modulus=10e6, viscosity=10e6)

ds = vc.simulate(
    vc.Paraboloid(radius, radius),
    vc.Material(law, poisson_ratio=0.5),
    vc.step(force),
    vc.Grid((96, 96), (3e-3, 3e-3)),
    vc.uniform_times(8.0, 80),
    fields=[0.0, 1.0, 8.0],
)

# %%
# The figure
# ----------
#
# Left: the pressure along x, and the Hertz pressure for the initial and the final compliance
# (dashed). Right: the peak pressure over time, with an error band that is thinner than the line.

figure, (left, right) = plt.subplots(1, 2, figsize=(7.2, 3.0), layout="constrained")
middle = len(ds.y) // 2
for time, colour in zip([0.0, 1.0, 8.0], ["#440154", "#21918c", "#d98c00"], strict=True):
    pressure = ds.pressure.sel(field_time=time)[:, middle]
    left.plot(ds.x * 1e3, pressure / 1e6, color=colour, label=f"{time:g} s")
for modulus, label in ((10e6, "Hertz"), (5e6, None)):  # finally both springs in series
    hertz = reference.hertz_sphere(force, radius, contact_modulus=2 * modulus / 0.5)
    x = np.linspace(-1.3e-3, 1.3e-3, 400)
    left.plot(x * 1e3, hertz.pressure(x) / 1e6, "k--", linewidth=0.8, label=label)
left.set(xlabel="x [mm]", ylabel="pressure [MPa]", xlim=(-1.3, 1.3), ylim=(0, 2.8))
left.legend(frameon=False, loc="upper left")

peak, bar = ds.peak_pressure / 1e6, ds.peak_pressure_error / 1e6
right.plot(ds.time, peak, color="#0072B2")
right.fill_between(ds.time, peak - bar, peak + bar, color="#0072B2", alpha=0.25, linewidth=0)
right.set(xlabel="time [s]", ylabel="peak pressure [MPa]")

# %%
# The check
# ---------
#
# At the end the body is elastic with half of the initial modulus: Hertz's p₀ = 3 F / (2 π a²).

final = (3 * force * radius / (4 * 4 * 5e6)) ** (1 / 3)
hertz_peak = 3 * force / (2 * np.pi * final**2)
ours = float(ds.peak_pressure[-1])

print(f"final peak pressure: {ours / 1e6:.4f} MPa, Hertz {hertz_peak / 1e6:.4f} MPa")
assert abs(ours / hertz_peak - 1) < 2e-3
