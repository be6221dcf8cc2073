"""
Two viscoelastic bodies
=======================

A plastic ball on a plastic plate: both bodies creep, each with its own law. Their contact
compliances add, so two creeping bodies cost no more than one.
"""

# %%
# Ball and plate
# --------------
#
# The creep of the ball ends, the plate flows. The second run has a rigid ball, for comparison.

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc

radius, force = 10e-3, 10.0
plate = vc.Material(vc.Maxwell(shear_modulus=400e6, viscosity=80e9), poisson_ratio=0.4)
ball = vc.Material(
    vc.Zener(shear_modulus=600e6, delayed_modulus=300e6, viscosity=9e9), poisson_ratio=0.35
)
shape, load = vc.Paraboloid(radius, radius), vc.step(force)
grid = vc.Grid((80, 80), (1.6e-3, 1.6e-3))
times = vc.uniform_times(400.0, 60)

both = vc.simulate(shape, plate, load, grid, times, indenter_material=ball, fields="none")
rigid = vc.simulate(shape, plate, load, grid, times, fields="none")

# %%
# The figure
# ----------
#
# The approach of both runs, and the exact solution with the sum of the two compliances (dots): Lee
# & Radok (1960), a²/R with a³ = (3/4) R F (J₁ + J₂), where J = (1 - ν) Φ of each body.

figure, axes = plt.subplots(figsize=(4.8, 3.2), layout="constrained")
compliances = plate.contact_compliance()(times), ball.contact_compliance()(times)
for ds, bodies, colour, label in (
    (both, sum(compliances), "#0072B2", "both creep"),
    (rigid, compliances[0], "#D55E00", "rigid ball"),
):
    axes.plot(times, ds.approach * 1e6, color=colour, label=label)
    exact = (0.75 * radius * force * bodies) ** (2 / 3) / radius
    axes.plot(times[::6], exact[::6] * 1e6, "ko", markersize=2.5)
axes.set(xlabel="time [s]", ylabel="approach [µm]", ylim=(0, None))
axes.legend(frameon=False)

# %%
# The check
# ---------
#
# The same comparison at the last instant, with the formulas of the two laws.

t = 400.0
flowing = (1 - 0.4) * (1 / 400e6 + t / 80e9) / 2
resting = (1 - 0.35) * (1 / 600e6 + (1 - np.exp(-t / 30.0)) / 300e6) / 2
exact = (0.75 * radius * force * (flowing + resting)) ** (2 / 3) / radius
ours = float(both.approach[-1])

print(f"approach after 400 s: {ours * 1e6:.3f} µm, exactly {exact * 1e6:.3f} µm")
assert abs(ours / exact - 1) < 1e-3
