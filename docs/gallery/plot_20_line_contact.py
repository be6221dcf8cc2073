"""
Line contact of a cylinder
==========================

A cylinder is much longer than its contact is wide, so that one row of cells across the strip
suffices. Just after loading, the pressure is that of Hertz's line contact; then the strip widens as
the material creeps, and the pressure is Hertz's again when the creep has come to its end.
"""

# %%
# One row of cells
# ----------------
#
# The cylinder has an infinite radius along x. The grid is one period along x, with a single cell,
# and ends along y; the force is that of one period.

import math
import warnings

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc

radius, line_load, period = 5e-3, 100e3, 1e-3  # m, N/m, m
law = vc.Zener(shear_modulus=1.2e9, delayed_modulus=1.2e9, viscosity=1.2e10)  # 10 s
material = vc.Material(law, poisson_ratio=0.38)
grid = vc.Grid((1, 160), (period, 1.6e-3), periodic=(True, False))
times = [0.0, *vc.log_times(0.1, 100.0, 40)[1:]]

with warnings.catch_warnings():  # a line contact on a half-space has no approach
    warnings.simplefilter("ignore", vc.AccuracyWarning)
    ds = vc.simulate(
        vc.Paraboloid(math.inf, radius),
        material,
        vc.step(line_load * period),
        grid,
        times,
        fields=[0.0, 100.0],
    )

# %%
# The exact strip
# ---------------
#
# Hertz's half width is :math:`b = \sqrt{4 R q J/\pi}` with the contact compliance
# :math:`J = 1/E^*`, and the peak pressure is :math:`p_0 = 2 q/(\pi b)` (Johnson 1985, eqs. 4.43 and
# 4.45). As the strip grows, the compliance at the same instant takes the place of :math:`1/E^*`
# (Lee & Radok 1960).

compliance = material.contact_compliance()(ds.time.values)
half_width = np.sqrt(4 * radius * line_load * compliance / math.pi)
peak = 2 * line_load / (math.pi * half_width)

# %%
# The figure
# ----------
#
# Pressure across the strip, and half width over time. The lines are exact, the markers computed.

figure, (across, over) = plt.subplots(1, 2, figsize=(7.2, 3.2), layout="constrained")
fine = np.linspace(-0.7e-3, 0.7e-3, 701)
for index, colour in ((0, "#0072B2"), (-1, "#D55E00")):
    exact = peak[index] * np.sqrt(np.maximum(1 - (fine / half_width[index]) ** 2, 0.0))
    across.plot(fine * 1e3, exact / 1e6, color=colour, lw=1)
    pressure, label = ds.pressure.isel(field_time=index, x=0) / 1e6, f"{float(ds.time[index]):g} s"
    across.plot(ds.y * 1e3, pressure, ".", color=colour, markersize=3, label=label)
across.set(xlabel="y [mm]", ylabel="pressure [MPa]", xlim=(-0.7, 0.7))
across.legend(frameon=False)
over.plot(ds.time[1:], half_width[1:] * 1e3, color="#0072B2", label="exact")
over.plot(
    ds.time[1:], ds.contact_width[1:] * 500, ".", color="#0072B2", markersize=5, label="computed"
)
over.set(xscale="log", xlabel="time [s]", ylabel="half width [mm]")
over.legend(frameon=False)

# %%
# The check
# ---------
#
# The half width at all instants, and the peak pressure at both ends of the creep.

computed, peaks = ds.contact_width.values / 2, ds.peak_pressure.values
assert np.abs(computed / half_width - 1).max() < 1e-3
for index, time in ((0, 0), (-1, 100)):
    print(f"half width at {time} s: {computed[index] * 1e3:.4f} mm", end=", ")
    print(f"exact {half_width[index] * 1e3:.4f}")
    print(f"peak pressure at {time} s: {peaks[index] / 1e6:.2f} MPa", end=", ")
    print(f"exact {peak[index] / 1e6:.2f}")
    assert abs(peaks[index] / peak[index] - 1) < 1e-3
