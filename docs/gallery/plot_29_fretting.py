"""
Fretting of a sphere
====================

A sphere that is pressed on a half-space and pulled to and fro slips in a ring around a part that
sticks. Force over shift is a loop, whose area is the heat of friction.
"""

# %%
# A cycle of the force
# --------------------
#
# Two equal bodies are pressed together, so that pressure and tractions are not coupled. The force
# along x is half of what friction carries.

import warnings

import numpy as np

import viscontact as vc

force, radius, friction = 10.0, 10e-3, 0.3
pull = 0.5 * friction * force
steel = vc.Material(vc.Elastic(40e9), poisson_ratio=0.0)
size = 2.4 * vc.reference.hertz_sphere(force, radius, 40e9).contact_radius
turns = np.arange(0, 2.26, 1 / 32)
# On coarse cells the ring is thin at first, of which a warning tells.
warnings.simplefilter("ignore", vc.AccuracyWarning)

ds = vc.simulate(
    vc.Paraboloid(radius, radius),
    steel,
    vc.step(force),
    vc.Grid((96, 96), (size, size)),
    turns,
    indenter_material=steel,
    friction=friction,
    tangential=vc.TangentialHistory(
        [0, 0.25, 0.75, 1.25, 1.75, 2.25], force_x=pull * np.array([0, 1, -1, 1, -1, 1])
    ),
    errors=False,
)

# %%
# Sticking and slipping cells
# ---------------------------
#
# Arrows are the tractions of the upper body on the lower one.

figure = vc.plot.stick_map(ds, times=[1.25, 1.5])

# %%
# The loop
# --------

figure = vc.plot.fretting_loop(ds)

# %%
# The check
# ---------
#
# From a reversal on, the shift is twice that of half the change of the force, which gives the heat
# of a cycle (Mindlin and Deresiewicz 1953).

exact = vc.reference.cattaneo_mindlin(force, radius, 40e9, pull, friction)
heat = float(
    np.interp(2.25, ds.time, ds.friction_heat) - np.interp(1.25, ds.time, ds.friction_heat)
)

print(f"heat of a cycle: {heat * 1e9:.3f} nJ, theory {exact.heat_of_cycle * 1e9:.3f} nJ")
assert abs(heat / exact.heat_of_cycle - 1) < 3e-3  # 40 cells on the radius
