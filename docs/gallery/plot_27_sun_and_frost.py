"""
Sun and frost
=============

A rubber foot stands on a bench for a week while the temperature varies between day and night. Its
times change by a factor of 30 000 between -10 °C and 30 °C, so that it creeps around noon only.
"""

# %%
# Two weeks of the same mean
# --------------------------
#
# A constant temperature of 10 °C, and days that swing about it.

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc

day, days = 86400.0, 7
shift = vc.WLF(reference_temperature=293.15, c1=8.86, c2=101.6)
law = vc.CreepSeries.from_uniaxial(
    5e-7, [1.5e-7, 2.5e-7, 6e-7], [3.6e3, 3.6e4, 3.6e5], poisson_ratio=0.49
)
rubber = vc.Material(law, poisson_ratio=0.49, shift=shift)
swings = vc.HarmonicTemperature(283.15, 20.0, day, days, phase=-np.pi / 2)
times = vc.uniform_times(days * day, 24 * days)

runs = {
    name: vc.simulate(
        *(vc.Sphere(0.04), rubber, vc.step(50.0), vc.Grid((40, 40), (28e-3, 28e-3)), times),
        temperature=temperature,
        fields="none",
        errors=False,
    )
    for name, temperature in (("days and nights", swings), ("always 10 °C", 283.15))
}

# %%
# The figure
# ----------
#
# Over the reduced time, the time at the reference temperature of the law, both are one curve.

figure, panels = plt.subplots(1, 2, figsize=(7.2, 3.2), layout="constrained", sharey=True)
for (name, ds), colour in zip(runs.items(), ["#0072B2", "#D55E00"], strict=True):
    panels[0].plot(ds.time / day, ds.approach * 1e3, color=colour, label=name)
    panels[1].semilogx(ds.reduced_time[1:] / 3600, ds.approach[1:] * 1e3, color=colour)
panels[0].set(xlabel="time [d]", ylabel="approach [mm]")
panels[1].set(xlabel="reduced time [h]")
panels[0].legend(frameon=False)

# %%
# The check
# ---------
#
# Under a constant force the approach is that of an elastic body of the compliance J(ξ) at the
# reduced time ξ (Lee & Radok 1960; Morland & Lee 1960), so it grows as J to the power 2/3.

ds = runs["days and nights"]
fine = np.linspace(0.0, days * day, 200_001)
reduced = float(np.trapezoid(1 / shift.factor(swings.at(fine)), fine))
expected = float((law(reduced) / law(0.0)) ** (2 / 3))
grown = float(ds.approach[-1] / ds.approach[0])

print(f"a week counts as {reduced / 3600:.0f} h; the approach has grown {grown:.4f} times,")
print(f"by the law over the reduced time {expected:.4f} times")
assert abs(float(ds.reduced_time[-1]) / reduced - 1) < 1e-8
assert abs(grown / expected - 1) < 5e-3  # of the cells
