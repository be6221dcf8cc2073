"""
Adaptive time steps
===================

A ball is loaded within one second and unloaded within another, and the surface then recovers. Short
steps are needed at the force maximum and when the contact is lost; long steps are sufficient
afterwards. With ``adaptive_times`` the run chooses its steps from an estimate of their error.
"""

# %%
# The run
# -------

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc

radius, force = 10e-3, 4.0
law = vc.Zener(shear_modulus=10e6, delayed_modulus=10e6, viscosity=10e6)
rubber = vc.Material(law, poisson_ratio=0.5)
grid = vc.Grid((72, 72), (2.8e-3, 2.8e-3))

ds = vc.simulate(
    vc.Paraboloid(radius, radius),
    rubber,
    vc.triangle(force, rise=1.0, fall=1.0),
    grid,
    vc.adaptive_times(10.0, tolerance=1e-3),
    fields="none",
)

# %%
# The figure
# ----------
#
# Above: the approach, with a dot for each step. An indentation remains after unloading and
# recovers. Below: the step sizes.

figure, (above, below) = plt.subplots(
    2, 1, figsize=(5.4, 4.2), sharex=True, layout="constrained", height_ratios=(3, 2)
)
above.plot(ds.time, ds.approach * 1e6, ".-", color="#0072B2", markersize=3, linewidth=0.8)
above.set(ylabel="approach [µm]", ylim=(0, None))
below.semilogy(ds.time[1:], np.diff(ds.time), ".", color="#0072B2", markersize=3)
below.set(xlabel="time [s]", ylabel="step [s]")
steps = np.diff(ds.time)
print(f"{steps.size} steps, from {steps.min() * 1e3:.1f} ms to {steps.max():.1f} s")

# %%
# The check
# ---------
#
# While the force increases, the approach is a²/R with a³ = (3/4) R ∫ J(t - t′) dF(t′) (Lee & Radok
# 1960).

mean_compliance = 0.5 / (2 * 10e6) * (2 - (1 - np.exp(-1.0)))
exact = (0.75 * force * mean_compliance / np.sqrt(radius)) ** (2 / 3)
ours = float(ds.approach.sel(time=1.0))

print(f"approach at the force maximum: {ours * 1e6:.3f} µm, exactly {exact * 1e6:.3f} µm")
assert abs(ours / exact - 1) < 1e-3
