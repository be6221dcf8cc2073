"""
An instrument's record
======================

An atomic force microscope moves a bead towards a gel until the force reaches a set point. It holds
the height while the force relaxes, holds the force while the bead sinks in, and withdraws until
contact is lost. When these events happen follows from the contact: the run locates them within its
time steps.
"""

# %%
# The program
# -----------
#
# Each segment goes on from the force or the approach that the one before has left. The
# corresponding case file is ``viscontact example afm-record``.

import numpy as np

import viscontact as vc
from viscontact import plot, reference

bead = vc.Paraboloid(5e-6, 5e-6)
law = vc.RelaxationSeries(equilibrium=500.0, moduli=[300.0, 200.0], times=[0.1, 1.0])
gel = vc.Material(law, poisson_ratio=0.5)
program = vc.LoadProgram(
    "move at 400 nm/s until force reaches 1.5 nN; hold height for 3 s; hold force for 3 s; "
    "retract at 400 nm/s until contact is lost"
)

ds = vc.simulate(
    bead,
    gel,
    program,
    vc.Grid((97, 97), (4.2e-6, 4.2e-6)),
    vc.adaptive_times(20.0, tolerance=1e-3),
    fields="none",
)
print(ds.attrs["events"])

# %%
# The figures
# -----------
#
# The record over time. Dotted lines are the events; the ends of the held segments are kinks.

figure = plot.history(ds)

# %%
# Force over approach, as instruments show it.

figure = plot.hysteresis(ds)

# %%
# The check
# ---------
#
# Under a rate v the force is (4/3) √R ∫ M(t - t') d(v t')^(3/2) with M(t) = 4 G(t) (Lee and Radok
# 1960). The end of contact follows from Ting (1966) for the approach of the whole record.

reached, lost = ds.attrs["event_times"]

# By Gauss-Legendre quadrature over u = √t', in which the integrand has no singularity.
nodes, weights = np.polynomial.legendre.leggauss(40)
times = np.linspace(0.1, 2.0, 4001)
u = np.sqrt(times)[:, None] * (1 + nodes) / 2
grown = (4 * law.relaxation(times[:, None] - u**2) * 3 * u**2) @ weights * np.sqrt(times) / 2
forces = 4 / 3 * np.sqrt(5e-6) * 400e-9**1.5 * grown
exact = float(np.interp(1.5e-9, forces, times))
record = reference.press_axisymmetric(
    reference.SphereProfile(5e-6),
    ds.time.values,
    approach=ds.approach.values,
    creep_compliance=gel.contact_compliance(),
    substeps=4,
)
largest = float(np.abs(ds.force.values - record.force).max() / ds.force.max())

print(f"set point reached after {reached:.5f} s, exactly {exact:.5f} s")
print(f"contact lost after {lost:.4f} s, largest deviation of the force {largest:.2%}")
assert abs(reached - exact) < 2e-4 * exact
assert largest < 3e-3
