"""
Von Mises stress below the surface
==================================

The von Mises stress determines where a body yields first. Under a ball, its maximum is below the
surface. As the body creeps and the contact grows, the maximum moves deeper and decreases.
"""

# %%
# The run
# -------
#
# A steel ball of 10 mm radius on a glassy polymer whose compliance grows to three times its initial
# value.

import matplotlib.pyplot as plt

import viscontact as vc
from viscontact import plot

law = vc.Zener(shear_modulus=1e9, delayed_modulus=0.5e9, viscosity=50e9)
polymer = vc.Material(law, poisson_ratio=0.3)

ds = vc.simulate(
    vc.Paraboloid(10e-3, 10e-3),
    polymer,
    vc.step(20.0),
    vc.Grid((81, 81), (1.5e-3, 1.5e-3)),
    vc.log_times(1.0, 1000.0, 19),
    fields=[0.0, 100.0, 1000.0],
)

# %%
# The figures
# -----------
#
# Contours of the von Mises stress on a section through the axis; crosses mark the maximum.

figure = plot.stress_section(ds)

# %%
# The stress on the axis below the contact: ``section_stresses`` returns a labelled dataset.

inside = vc.section_stresses(ds)
axis = inside.von_mises.sel(x=0.0, method="nearest")

figure, axes = plt.subplots(figsize=(4.6, 3.4), layout="constrained")
for time, colour in zip(axis.time.values, ["#440154", "#21918c", "#d98c00"], strict=True):
    here = axis.sel(time=time)
    axes.plot(here / 1e6, here.z * 1e3, color=colour, label=f"{time:g} s")
axes.set(xlabel="von Mises stress on the axis [MPa]", ylabel="depth [mm]", xlim=(0, None))
axes.invert_yaxis()
axes.legend(frameon=False)

# %%
# The check
# ---------
#
# For Hertz pressure and ν = 0.3, the largest von Mises stress is 0.62 p₀ at a depth of 0.48 a
# (Johnson 1985, section 4.2).

first = axis.sel(time=0.0)
ratio = float(first.max() / ds.peak_pressure[0])
depth = float(first.z[first.values.argmax()] / (ds.contact_length[0] / 2))

print(f"largest von Mises stress: {ratio:.3f} of the peak pressure, {depth:.2f} radii deep")
assert abs(ratio - 0.620) < 0.005
assert abs(depth - 0.48) < 0.03
