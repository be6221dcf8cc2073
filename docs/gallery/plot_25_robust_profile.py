"""
A robust profile
================

A roller is loaded in its middle, or 2.5 mm beside it. Which profile has the least peak pressure in
the worse of both cases? The drop curve itself is searched for, not the parameter of a named one, as
by ``viscontact design roller.yaml --profile free``.
"""

# %%
# The case and its scenarios
# --------------------------

import math
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt

import viscontact as vc

half_length, radius, force, shift = 10e-3, 50e-3, 800.0, 2.5e-3
modulus = 2e9 / (1 - 0.35)  # E* of the half-space under a rigid roller
case = Path(tempfile.mkdtemp(), "roller.yaml")
case.write_text(
    """
indenter: {shape: roller, radius: 50 mm, half_length: 10 mm}
material: {law: elastic, shear_modulus: 1 GPa, poisson_ratio: 0.35}
load: {kind: step, force: 800 N}
time: {end: 1 s, steps: 1}
grid: {shape: [108, 55], size: [21.6 mm, 4 mm]}
output: {errors: false}
"""
)
over = {"load.eccentricity_x": ["0 mm", "2.5 mm"]}
found = vc.design_profile(case, knots=4, over=over, workers=1)
runs = found.before_and_after()  # the best named profile and the free one, in the worst scenario

# %%
# The figure
# ----------
#
# Below, the line load of the eccentric force. The free profile drops more between the middle and
# the ends. That makes the line load nearly even on the loaded side; under the best named profile it
# has a maximum near the end.

figure, (above, below) = plt.subplots(2, 1, figsize=(6.4, 5.4), sharex=True, layout="constrained")
for (name, run), colour in zip(runs.items(), ["#D55E00", "#0072B2"], strict=True):
    drop = found.table["drop"].sel(profile=name)
    above.plot(found.x * 1e3, drop * 1e6, color=colour, label=name)
    load = run.pressure[0].sum("y") * (run.y[1] - run.y[0])
    below.plot(run.x * 1e3, load / 1e3, color=colour, label=name)
above.set(ylabel="drop [µm]", ylim=(60, -3))
above.legend(frameon=False)
below.set(xlabel="x [mm]", ylabel="line load [N/mm]")

# %%
# The check
# ---------
#
# The least possible pressure under the eccentric force is the even one of a long contact that is
# centred on the force and ends with the roller (Hertz): p₀ = sqrt(w E*/(π R)), w = F/(2 (L - e)).

even = (force / (2 * (half_length - shift)) * modulus / (math.pi * radius)) ** 0.5
named = float(found.table.peak_pressure.sel(profile=found.best_named))
print(f"best named profile ({found.best_named}): {named / 1e6:.1f} MPa")
print(f"free profile: {found.peak_pressure / 1e6:.1f} MPa, even pressure: {even / 1e6:.1f} MPa")
assert even < found.peak_pressure < 0.98 * named
