"""
A sphere that sticks
====================

A sphere comes to a soft elastic body, jumps into contact, is pressed, and is withdrawn until it
comes off. In contact its force is that of the exact solution of Maugis.
"""

# %%
# Approach and withdrawal
# -----------------------
#
# The surfaces attract each other with the same stress up to a gap, the range of Dugdale's law. Here
# it gives a Tabor number of 0.7, between the limits of long and of short ranges.

import warnings

import numpy as np

import viscontact as vc

radius, modulus, work, reach = 10e-6, 1e6, 0.05, 420e-9  # [m], E* [Pa], [J/m²], [m]
tabor = vc.reference.tabor_number(radius, 1 / modulus, work, reach)
exact = vc.reference.maugis_dugdale(radius, 1 / modulus, work, reach)

# Few cells lie across the cohesive zone, which a warning tells; they are enough here.
warnings.simplefilter("ignore", vc.AccuracyWarning)
ds = vc.simulate(
    vc.Paraboloid(radius, radius),
    vc.Material(vc.Elastic(modulus / 4), poisson_ratio=0.5),
    vc.ApproachHistory([0, 1, 2.2], [-0.6e-6, 0.4e-6, -0.8e-6]),
    vc.Grid((72, 72), (20e-6, 20e-6)),
    vc.uniform_times(2.2, 44),
    adhesion=vc.Adhesion(work, range=reach, law="dugdale"),
    errors=False,
    fields=[1.0, 1.6],
)
print(f"Tabor number {tabor:.2f}")
print(ds.attrs["events"])

# %%
# The force curve
# ---------------
#
# The points are exact; they end at the least approach that holds contact.

figure = vc.plot.force_curve(ds)
states = [exact.at_approach(each) for each in np.linspace(0.999 * exact.last.approach, 0.4e-6, 12)]
axes = figure.axes[0]
axes.plot(
    [1e9 * state.approach for state in states],
    [1e6 * state.force for state in states],
    "o",
    color="black",
    markersize=3.5,
    markerfacecolor="none",
    label="Maugis 1992",
)
axes.legend(frameon=False)

# %%
# Tension around the contact
# --------------------------
#
# Under the pull the pressure in the middle of the contact is surrounded by a ring of tension, as
# large as the law allows, which reaches beyond the line that surrounds the contact.

figure = vc.plot.pressure_map(ds, times=[1.0, 1.6])

# %%
# The check
# ---------

pull = exact.pull_off.force
print(f"pull-off force {ds.attrs['pull_off_force'] * 1e6:.3f} µN, exact {-pull * 1e6:.3f} µN")
assert abs(ds.attrs["pull_off_force"] / -pull - 1) < 0.01
bound = (ds.time > 1.0) & (ds.approach > 0.8 * exact.last.approach)
there = np.array([exact.at_approach(each).force for each in ds.approach.values[bound]])
assert np.abs(ds.force.values[bound] - there).max() < 0.02 * abs(pull)
