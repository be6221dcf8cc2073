"""
Rubber that holds more the faster it is pulled
==============================================

A sphere rests on rubber and is withdrawn. The edge of the contact recedes over material that has
not relaxed, so that the rubber holds the more, the faster the sphere is withdrawn, and the more,
the longer it has rested.
"""

# %%
# Withdrawal at many speeds
# -------------------------
#
# The rubber is ten times as stiff at once as at last; its retardation time is a second.

import warnings

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr

import viscontact as vc

radius, relaxed, ratio, work = 10e-6, 0.25e6, 10.0, 0.05  # [m], shear modulus [Pa], [-], [J/m²]
delayed = relaxed / (1 - 1 / ratio)
rubber = vc.Material(vc.Zener(relaxed * ratio, delayed, delayed * 1.0), poisson_ratio=0.5)
length = np.cbrt(0.75 * np.pi * work * radius**2 / (4 * relaxed))
depth, unit = length**2 / radius, np.pi * work * radius
reach = np.cbrt(radius * (work / (4 * relaxed)) ** 2)  # Tabor number 1 at last
grid = vc.Grid((40, 40), (8 * length, 8 * length))
# Few cells lie across the cohesive zone, which a warning tells; they are enough here.
warnings.simplefilter("ignore", vc.AccuracyWarning)


def withdrawn(speed: float, dwell: float) -> xr.Dataset:
    """Run of a sphere that rests at the touching approach, and is withdrawn [depths/s, s]."""
    way = np.array([0.0, 0.0, -5.0]) * depth
    times = np.array([0.0, dwell, dwell + 5.0 / speed])
    return vc.simulate(
        *(vc.Paraboloid(radius, radius), rubber, vc.ApproachHistory(times, way), grid, times),
        adhesion=vc.Adhesion(work, range=reach),
        errors=False,
        fields="none",
    )


speeds = np.geomspace(1e-3, 1e1, 4)  # [depths/s]
ends = speeds[[0, -1]]
pulls = {
    dwell: np.array([withdrawn(speed, dwell).attrs["pull_off_force"] for speed in chosen]) / unit
    for dwell, chosen in ((1e-3, ends), (20.0, speeds))
}

# %%
# The figure
# ----------
#
# A sphere that has hardly rested meets an elastic body, the relaxed one when it is withdrawn slowly
# and the stiff one when fast: it holds :math:`\frac{3}{2}` to :math:`2 \pi w R`. After a long rest
# the contact is as large as that of the relaxed rubber, and a fast withdrawal finds it stiff.

figure, axes = plt.subplots(figsize=(5.2, 3.6), layout="constrained")
short, long = pulls.values()
axes.semilogx(speeds * depth * 1e6, long, "o-", label="after 20 s of rest")
axes.plot(ends * depth * 1e6, short, "s", mfc="none", label="after 1 ms of rest")
axes.axhspan(1.5, 2.0, color="0.9", label="elastic spheres, JKR to DMT")
axes.set(xlabel="speed [µm/s]", ylabel="pull-off force over $\\pi w R$", ylim=(1.2, 4.0))
axes.legend(frameon=False, loc="upper left")

# %%
# The check
# ---------
#
# The slowest withdrawal is that of the relaxed elastic body, which holds :math:`1.664 \pi w R` at
# this Tabor number by an axisymmetric computation.

print(f"slow {short[0]:.3f} and {long[0]:.3f}, fast {short[-1]:.3f} and {long[-1]:.3f}")
assert np.abs(np.array([short[0], long[0]]) / 1.664 - 1).max() < 0.01
assert short.min() > 1.5
assert short.max() < 2.0
assert (np.diff(long) > 0).all()
assert long[-1] < 2.0 * ratio
