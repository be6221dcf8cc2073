"""
Periodic contact of a wavy surface
==================================

An infinite wavy surface is pressed on a creeping rubber. The grid is one wavelength, and the
contact may cross the border of the grid, because the next wave is the same. Each crest touches
along a strip, which widens until the waves are nearly flat.
"""

# %%
# One period
# ----------
#
# ``periodic=True`` makes the grid one period. The load is a mean pressure: the force divided by the
# area of the period.

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc
from viscontact import reference

amplitude, wavelength, mean_pressure = 1e-6, 1e-3, 0.75e6
law = vc.Zener(shear_modulus=250e6, delayed_modulus=125e6, viscosity=1.25e9)
body = vc.Material(law, poisson_ratio=0.4)
grid = vc.Grid((256, 4), (wavelength, wavelength / 64), periodic=True)

ds = vc.simulate(
    vc.Waviness(amplitude, wavelength_x=wavelength),
    body,
    vc.step(mean_pressure * grid.size[0] * grid.size[1]),
    grid,
    vc.log_times(0.1, 100.0, 31),
    fields=[0.0, 1.0, 10.0, 100.0],
)

# %%
# The figure
# ----------
#
# Left: the pressure on one wave. Right: the width of the strip, and Westergaard's solution (1939)
# for an elastic body with the compliance at each instant.

figure, (left, right) = plt.subplots(1, 2, figsize=(7.2, 3.0), layout="constrained")
colours = ["#440154", "#31688e", "#21918c", "#d98c00"]
for time, colour in zip(ds.field_time.values, colours, strict=True):
    field = ds.pressure.sel(field_time=time)[:, 0]
    left.plot(ds.x * 1e3, field / 1e6, color=colour, label=f"{time:g} s")
left.set(xlabel="x [mm]", ylabel="pressure [MPa]", ylim=(0, None))
left.legend(frameon=False, loc="upper left")

times = ds.time.values
moduli = 1 / body.contact_compliance()(times)
exact = np.array(
    [
        2 * reference.westergaard(mean_pressure, amplitude, wavelength, modulus).half_width
        for modulus in moduli
    ]
)
right.semilogx(times[1:], ds.contact_length[1:] * 1e3, "o", markersize=3, label="computed")
right.semilogx(times[1:], exact[1:] * 1e3, "k-", linewidth=1, label="Westergaard")
right.set(xlabel="time [s]", ylabel="width of the strip [mm]")
right.legend(frameon=False)

# %%
# The check
# ---------
#
# Full contact needs the mean pressure p* = π E* Δ/λ, with Δ the amplitude. Under a smaller mean
# pressure p, the width of the strip is 2 a with sin²(π a/λ) = p/p*.

full = np.pi * moduli[-1] * amplitude / wavelength
width = 2 * wavelength / np.pi * np.arcsin(np.sqrt(mean_pressure / full))
ours = float(ds.contact_length[-1])

print(f"strip after 100 s: {ours * 1e3:.4f} mm wide, exactly {width * 1e3:.4f} mm")
assert abs(ours / width - 1) < 5e-3
