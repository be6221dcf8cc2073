"""
Cyclic loading and hysteresis loss
==================================

A flat punch is pressed on rubber by a force that oscillates about a mean value. The approach lags
behind the force, so force against approach is a loop. Its area is the energy that is lost as heat
in each cycle.
"""

# %%
# Three frequencies
# -----------------
#
# The contact area of the punch does not change, so the problem is linear. The loss is largest where
# the angular frequency times the retardation time of 0.5 s is 1, at a period of 3.1 s.

import warnings

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc

radius, mean, amplitude = 2e-3, 20.0, 10.0
law = vc.Zener(shear_modulus=10e6, delayed_modulus=10e6, viscosity=5e6)  # 0.5 s
rubber = vc.Material(law, poisson_ratio=0.5)
grid = vc.Grid((48, 48), (4.4e-3, 4.4e-3))
# The pressure is singular at the edge. The warning is switched off: the approach is not affected.
warnings.simplefilter("ignore", vc.AccuracyWarning)

runs = {
    period: vc.simulate(
        vc.FlatPunch(radius),
        rubber,
        vc.harmonic(mean, amplitude, period, cycles=8),
        grid,
        vc.uniform_times(8 * period, 8 * 64),
        fields="none",
        errors=False,
    )
    for period in (0.3, 2.0, 20.0)
}

# %%
# The figure
# ----------
#
# The last cycle of each run: force against the approach minus its mean.

figure, axes = plt.subplots(figsize=(4.8, 3.4), layout="constrained")
for (period, ds), colour in zip(runs.items(), ["#0072B2", "#D55E00", "#009E73"], strict=True):
    last = ds.isel(time=slice(-65, None))
    loss = float(ds.loss_per_cycle[-1])
    axes.plot(
        (last.approach - last.approach.mean()) * 1e6,
        last.force,
        color=colour,
        label=f"{period:g} s: {loss * 1e6:.0f} µJ",
    )
axes.set(xlabel="approach about its mean [µm]", ylabel="force [N]")
axes.legend(frameon=False, title="period: loss per cycle")

# %%
# The check
# ---------
#
# The approach of a punch is F J/(2 a), so the loss per cycle is π F₁² J″/(2 a), with the complex
# compliance J* = J′ - i J″ at the frequency (Ferry 1980). The cells approximate the round punch by
# a slightly different shape; its value of 1/(2 a) follows from the first instant.

period = 2.0
complex_compliance = 0.5 / (2 * complex(law.complex_modulus(2 * np.pi / period)))
per_compliance = float(runs[period].approach[0]) / (mean * 0.5 * law(0.0))
exact = np.pi * amplitude**2 * -complex_compliance.imag * per_compliance
ours = float(runs[period].loss_per_cycle[-1])

print(f"loss per cycle: {ours * 1e6:.3f} µJ, from the complex compliance {exact * 1e6:.3f} µJ")
assert abs(ours / exact - 1) < 3e-3  # 64 steps per cycle: (2 π/64)²/6 = 1.6e-3
