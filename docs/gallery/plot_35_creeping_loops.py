"""
Loops of a creeping contact
===========================

A ball is shaken along a rubber pad. The loop of force over shift encloses what is lost: heat where
the surfaces slip, and loss in the rubber, which depends on the frequency.
"""

# %%
# Three frequencies
# -----------------
#
# The ball has rested on the pad for long, then the force along it swings. Slowly and fast the
# rubber is elastic, softer and stiffer; between, it creeps within a cycle.

import math
import warnings

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc

radius, force, friction = 10e-3, 10.0, 0.3  # m, N
modulus, delayed, time = 8e6, 4e6, 1.0  # Pa, Pa, s; retardation
rubber = vc.Material(vc.Zener(modulus, delayed, delayed * time), poisson_ratio=0.5)
pull, rest = 0.3 * friction * force, 60.0
warnings.simplefilter("ignore", vc.AccuracyWarning)

runs = {}
for name, period in (("slow", 60.0), ("medium", 4.0), ("fast", 0.05)):
    angles = 2 * math.pi * np.linspace(0.0, 2.25, 55)
    times = rest + period * angles / (2 * math.pi)
    runs[name] = vc.simulate(
        vc.Paraboloid(radius, radius),
        rubber,
        vc.step(force),
        vc.Grid((32, 32), (5.4e-3, 5.4e-3)),
        times,
        friction=friction,
        tangential=vc.TangentialHistory([0.0, *times], force_x=[0.0, *(pull * np.sin(angles))]),
        errors=False,
    )

figure, axes = plt.subplots(figsize=(4.8, 3.4), layout="constrained")
for (name, ds), colour in zip(runs.items(), ("#440154", "#d98c00", "#287d8e"), strict=True):
    cycle = ds.isel(time=slice(30, None))  # from a reversal on
    shift = 1e6 * cycle.tangential_displacement_x
    axes.plot(shift, cycle.tangential_force_x, color=colour, label=name)
axes.legend(frameon=False)
axes.set(xlabel="Shift [µm]", ylabel="Force along the pad [N]")

# %%
# What is lost
# ------------
#
# The area of the loop of the last cycle, and the heat of friction in it.

areas, heats = {}, {}
for name, ds in runs.items():
    cycle = ds.isel(time=slice(30, 55))
    shift, along = cycle.tangential_displacement_x.values, cycle.tangential_force_x.values
    areas[name] = float(np.sum((along[1:] + along[:-1]) / 2 * np.diff(shift)))
    heats[name] = float(cycle.friction_heat[-1] - cycle.friction_heat[0])
    print(f"{name:>6}: {1e6 * areas[name]:6.2f} µJ lost, {1e6 * heats[name]:5.2f} µJ of it by slip")

# %%
# The check
# ---------
#
# Where nothing slips the shift is (2 - ν)/(8 a) times the creep compliance 1/G(t) on the force, and
# a cycle loses π Q² (2 - ν)/(8 a) times its loss compliance. Under this force, three tenths of what
# friction carries, little slips: what is left of the area without heat is the loss of the rubber.

half_width = float(runs["medium"].contact_width[-1]) / 2
frequency = 2 * math.pi / 4.0
loss_compliance = frequency * time / (1 + (frequency * time) ** 2) / delayed
loss = math.pi * pull**2 * (2 - 0.5) / (8 * half_width) * loss_compliance
left = areas["medium"] - heats["medium"]
print(f"medium: {1e6 * left:.2f} µJ lost in the rubber, {1e6 * loss:.2f} µJ where nothing slips")
assert abs(left / loss - 1) < 0.05
assert areas["medium"] > 3 * areas["fast"]
