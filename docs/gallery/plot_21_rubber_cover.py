"""
Ball on a rubber cover
======================

A ball on a rubber cover that is bonded to a steel core. The thinner the cover, the less the ball
sinks in, and the higher the pressure: a nearly incompressible rubber can hardly move aside.
"""

# %%
# Covers of three thicknesses
# ---------------------------
#
# The rubber relaxes to a third of its shear modulus. Its bulk modulus is elastic and a thousand
# times larger, so that Poisson's ratio varies in time, from 0.4985 to 0.4995.

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc

radius, force = 10e-3, 0.5
rubber = vc.Material(
    vc.Zener(shear_modulus=2e6, delayed_modulus=1e6, viscosity=1e6), bulk_modulus=2e9
)
steel = vc.Material(vc.Elastic(80e9), poisson_ratio=0.3)
ball, load, times = vc.Paraboloid(radius, radius), vc.step(force), vc.log_times(0.01, 10.0, 24)

runs = {}
for thickness in (10e-3, 1e-3, 0.5e-3):
    cover = vc.Layered([vc.Layer(thickness, rubber)], base=steel)
    runs[thickness] = vc.simulate(ball, cover, load, times=times, errors=False)

# %%
# The figure
# ----------
#
# The pressure along the middle at the first and at the last instant (dashed).

figure, axes = plt.subplots(figsize=(4.8, 3.2), layout="constrained")
for (thickness, ds), colour in zip(runs.items(), ("#0072B2", "#D55E00", "#009E73"), strict=True):
    profile = ds.pressure.sel(y=0.0, method="nearest") / 1e6
    label = f"{thickness * 1e3:g} mm"
    axes.plot(ds.x * 1e3, profile[0], color=colour, label=label)
    axes.plot(ds.x * 1e3, profile[-1], "--", color=colour)
axes.set(xlabel="x [mm]", ylabel="pressure [MPa]", xlim=(-1.5, 1.5), ylim=(0, None))
axes.legend(title="cover", frameon=False)

# %%
# The check
# ---------
#
# Before any creep the contact is that of an elastic layer. The core yields so little that an exact
# solution for a rigid base applies: the force of the contact radius, by a Fredholm equation.

nu = (3 * 2e9 - 2 * 2e6) / (2 * (3 * 2e9 + 2e6))
ours = runs[1e-3].isel(time=0)
a = float(np.sqrt(ours.contact_area / np.pi))
exact = vc.reference.layer_sphere(a, radius, 1e-3, shear_modulus=2e6, poisson_ratio=nu)

print(f"contact radius {a * 1e3:.3f} mm: force {exact.force:.3f} N, approach")
print(f"{float(ours.approach) * 1e6:.2f} µm, exactly {exact.approach * 1e6:.2f} µm")
print(f"error of the separation: {ours.attrs['splitting_error']:.0e}")
assert abs(exact.force / force - 1) < 5e-3
assert abs(float(ours.approach) / exact.approach - 1) < 5e-3
