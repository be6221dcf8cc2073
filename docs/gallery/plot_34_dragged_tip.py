"""
Lateral force on a tip
======================

A tip rests on a rubber and is dragged sideways. At first all of the contact sticks and the surface
bends like a spring; then a ring slips, which grows inwards, until the tip slides.
"""

# %%
# Force over the way of the tip
# -----------------------------
#
# The tip is pressed on and rests for a second, in which the contact grows by creep. Then its shift
# is prescribed, as that of a stiff scanner. Dragged slowly, the rubber creeps along the surface,
# too: the tip goes farther before it slides.

import warnings

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc

radius, force, friction = 30e-9, 1e-9, 0.5  # m, N
modulus, delayed, time = 20e6, 40e6, 0.01  # Pa, Pa, s
rubber = vc.Material(vc.Zener(modulus, delayed, delayed * time), poisson_ratio=0.5)
warnings.simplefilter("ignore", vc.AccuracyWarning)

runs = {}
for name, duration in (("in 0.1 ms", 1e-4), ("in 1 s", 1.0)):
    ways = np.linspace(0.0, 2e-9, 25)
    runs[name] = vc.simulate(
        vc.Paraboloid(radius, radius),
        rubber,
        vc.step(force),
        vc.Grid((48, 48), (21e-9, 21e-9)),
        1.0 + duration * ways / ways[-1],
        friction=friction,
        tangential=vc.TangentialHistory(
            [0.0, 1.0, 1.0 + duration], displacement_x=[0.0, 0.0, 2e-9]
        ),
        errors=False,
    )

figure, axes = plt.subplots(figsize=(4.8, 3.4), layout="constrained")
for (name, ds), colour in zip(runs.items(), ("#440154", "#d98c00"), strict=True):
    way, pull = 1e9 * ds.tangential_displacement_x, 1e9 * ds.tangential_force_x
    axes.plot(way, pull, color=colour, label=f"2 nm {name}")
axes.axhline(1e9 * friction * force, color="gray", linestyle=":")
axes.set(xlabel="Shift of the tip [nm]", ylabel="Lateral force [nN]", xlim=(0, 2), ylim=(0, None))
axes.legend(frameon=False, loc="lower right")

# %%
# The ring that slips
# -------------------

fast = runs["in 0.1 ms"]
figure = vc.plot.stick_map(fast, times=fast.time.values[[3, 7, 10]])

# %%
# The check
# ---------
#
# While nearly all of the contact sticks, the stiffness is 8 a G/(2 - ν) (Mindlin 1949), with the
# radius a of the contact that has grown, and the modulus G at once.

first = float(fast.tangential_stiffness_x[1])
width = float(fast.contact_width[0]) / 2
theory = 8 * width * modulus / (2 - 0.5)
print(f"stiffness {first:.3f} N/m, theory {theory:.3f} N/m")
assert abs(first / theory - 1) < 0.06  # a part slips in the first step already
end = float(fast.tangential_force_x[-1])
assert abs(end / (friction * force) - 1) < 1e-6
