"""
Sphere on a Maxwell half-space
==============================

A ball of 10 mm radius is loaded on a Maxwell body (a spring and a dashpot in series), and the load
is held: Fig. 6 of Spinu & Cerlinca (2018). The contact grows without limit. The initial pressure is
that of Hertz. Later it becomes lowest in the middle, because the material there has relaxed, while
material at the contact edge has just come into contact.
"""

# %%
# The case
# --------
#
# All values are in SI units. Hertz, Lee & Radok and the paper approximate the ball by a paraboloid.

import math

import viscontact as vc
from viscontact import plot

radius, force = 10e-3, 2.0
law = vc.Maxwell(shear_modulus=10e6, viscosity=10e6)  # relaxes within 1 s
body = vc.Material(law, poisson_ratio=0.5)

ds = vc.simulate(
    vc.Paraboloid(radius, radius),
    body,
    vc.step(force),
    vc.Grid((96, 96), (3e-3, 3e-3)),
    vc.uniform_times(3.0, 60),
    fields=[0.0, 0.5, 1.0, 2.0, 3.0],
)

# %%
# The figure
# ----------
#
# Markers are computed cells; lines are the solution of Lee & Radok (1960). The lower panel shows
# the differences.

figure = plot.pressure_radial(ds)

# %%
# The check
# ---------
#
# Eq. 16 of the paper: a³ = (3/8) R W Φ(t), with Φ = 1/(2 G) + t/(2 η).

phi = 1 / (2 * 10e6) + 3.0 / (2 * 10e6)
exact = (3 / 8 * radius * force * phi) ** (1 / 3)
computed = math.sqrt(float(ds.contact_area[-1]) / math.pi)

print(f"contact radius after 3 s: {computed * 1e3:.4f} mm, exactly {exact * 1e3:.4f} mm")
assert abs(computed / exact - 1) < 2e-3
