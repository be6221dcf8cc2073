"""
AFM indentation of a gel
========================

The piezo of an atomic force microscope presses a bead of 5 µm radius 400 nm into a soft gel within
a second, and withdraws it at the same speed. The gel recovers more slowly than the bead moves:
during withdrawal the contact is lost before the bead has left the indentation. There is no
adhesion, so the force is never tensile.
"""

# %%
# The case
# --------
#
# The approach is prescribed, and the force is computed. The time steps are adaptive. The
# corresponding case file is ``viscontact example afm-indentation``.

import viscontact as vc
from viscontact import plot, reference

bead = vc.Paraboloid(5e-6, 5e-6)
gel = vc.Material(
    vc.RelaxationSeries(equilibrium=500.0, moduli=[300.0, 200.0], times=[0.1, 1.0]),
    poisson_ratio=0.5,
)
stage = vc.ApproachHistory(times=[0.0, 1.0, 3.0], approach=[0.0, 400e-9, -400e-9])

ds = vc.simulate(
    bead,
    gel,
    stage,
    vc.Grid((96, 96), (3.8e-6, 3.8e-6)),
    vc.adaptive_times(3.0, tolerance=1e-3),
    fields=[0.5, 1.0, 1.2, 1.4],
)

# %%
# The figures
# -----------
#
# Force against approach. The arrows show the direction of time; the area of the loop is lost as
# heat. The error band is thinner than the line.

figure = plot.hysteresis(ds)

# %%
# The pressure during indentation and withdrawal: the contact edge loses contact first.

figure = plot.pressure_profile(ds)

# %%
# The check
# ---------
#
# Ting (1966) gives the force and the time of contact loss in closed form, for M(t) = 2 G(t)/(1 -
# ν) = 4 G(t).

exact = reference.ting_triangle(
    reference.SphereProfile(5e-6), 400e-9, 1.0, 2000.0, [1200.0, 800.0], [0.1, 1.0]
)
ours, theirs = float(ds.force.sel(time=1.2)), float(exact.force(1.2))
touching = ds.time.values[ds.force.values > 0]

print(f"force during withdrawal, 1.2 s: {ours * 1e12:.2f} pN, Ting {theirs * 1e12:.2f} pN")
print(f"contact is lost after {touching[-1]:.3f} s, Ting {exact.lost:.3f} s")
assert abs(ours - theirs) < 3e-3 * float(exact.force(1.0))
assert abs(touching[-1] - exact.lost) < 0.03
