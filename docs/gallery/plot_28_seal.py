"""
The load at which a seal closes
===============================

A rough surface is pressed on an elastic body with a force that rises. Fluid leaks through the
channels between the contact spots. Its flow falls over many decades, until the last channel closes:
from then on nothing leaks.
"""

# %%
# A rough surface
# ---------------
#
# A random surface that repeats itself, with five waves of the longest kind on a period, and an rms
# slope of 0.1.

import warnings

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc

count, period, slope = 128, 1e-3, 0.1
random = np.random.default_rng(4)
k = np.fft.fftfreq(count) * count
waves = np.hypot(k[:, None], k)
size = np.where((waves >= 2) & (waves <= 16), np.maximum(waves, 5.0) ** -1.8, 0.0)
height = np.fft.ifft2(size * np.exp(2j * np.pi * random.random((count, count)))).real
change = np.abs(2j * np.pi * waves / period * np.fft.fft2(height)) ** 2
height *= slope / np.sqrt(change.sum() / count**4)

# %%
# A force that rises
# ------------------

modulus = 10e6  # E* [Pa]
body = vc.Material(vc.Elastic.from_uniaxial(modulus * (1 - 0.49**2), 0.49), poisson_ratio=0.49)
grid = vc.Grid((count, count), (period, period), periodic=True)
loads = np.linspace(0.01, 0.26, 26)  # mean pressure over E* times the slope
load = vc.ForceHistory(np.arange(26.0), loads * modulus * slope * grid.area)
surface = vc.surfaces.indenter_of(vc.Surface(height, period / count, periodic=True))
# Eight cells on the shortest wave: the peaks of pressure, which are not used here, need more.
warnings.filterwarnings("ignore", "between neighbouring points of the grid", vc.AccuracyWarning)
ds = vc.simulate(surface, body, load, grid, np.arange(26.0), errors=False)
leak = vc.leakage(ds, viscosity=1e-3, pressure_difference=1e3, along="both")

# %%
# The figure
# ----------
#
# Left: the transmissivity over the real contact area, along x and along y, and an effective medium,
# which knows the distribution of the gaps only. Right: the flow at the last instant that is open
# along x.

area = ds.contact_area.values / grid.area
figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 3.3), layout="constrained")
scale = height.std() ** 3 / 12
for direction, marker in (("x", "o"), ("y", "s")):
    values = leak.transmissivity.sel(direction=direction).values
    shown = np.where(values > 0, values, np.nan) / scale
    left.semilogy(area, shown, f"{marker}-", markersize=3, label=f"along {direction}")
medium = leak.transmissivity_effective_medium.sel(direction="x").values / scale
left.semilogy(area, np.where(medium > 0, medium, np.nan), "k--", label="effective medium")
left.set(xlabel="real over nominal area", ylabel="transmissivity over rms³/12", ylim=(1e-6, 10))
left.legend(frameon=False)

opened = leak.percolates.sel(direction="x").values > 0
last = int(np.flatnonzero(opened)[-1])
at = vc.leakage(ds.isel(time=[last]), viscosity=1e-3, pressure_difference=1e3, fields="all").isel(
    time=0
)
flow = np.hypot(at.flux_x, at.flux_y)
flow = np.where(flow > 1e-4 * flow.max(), flow / flow.max(), np.nan)
right.pcolormesh(ds.x * 1e6, ds.y * 1e6, np.log10(flow).T, rasterized=True)
right.plot(at.critical_x * 1e6, at.critical_y * 1e6, "o", mfc="none", mec="#d95f02", ms=11, mew=1.6)
right.set(
    xlabel="x [µm]", ylabel="y [µm]", aspect="equal", title=f"{100 * area[last]:.0f} % contact"
)
print(f"open along x up to {area[last]:.3f}, closed from {area[last + 1]:.3f} on")

# %%
# Isotropic surfaces close at a real area of about 0.42 of the nominal one (Dapp et al. 2012); a
# single map of this size deviates by a few hundredths. The effective medium closes there as well.

assert 0.35 < area[last] < area[last + 1] < 0.49
gentle = area < 0.2
mean = leak.transmissivity.mean("direction").values[gentle] / scale
assert np.all(np.abs(np.log(medium[gentle] / mean)) < 0.7)
