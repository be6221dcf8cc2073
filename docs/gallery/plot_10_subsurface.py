"""
Where a body yields first
=========================

Below a ball the pressure is highest at the surface, and what makes a body yield, the von Mises
stress, is highest inside. As the body creeps, the place moves down with the growing contact, and
the stress falls.
"""

# %%
# The run
# -------
#
# A steel ball of 10 mm radius on a glassy polymer that creeps to three times its compliance.

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
# The picture
# -----------
#
# Contours of the von Mises stress on a section through the axis; crosses mark the largest one.

figure = plot.stress_section(ds)

# %%
# The stress on the axis below the contact, with labels: ``section_stresses`` gives a dataset.

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
# Below a dome of Hertz, at ν = 0.3, the largest von Mises stress is 0.62 p₀ at a depth of 0.48 a
# (Johnson 1985, section 4.2).

first = axis.sel(time=0.0)
ratio = float(first.max() / ds.peak_pressure[0])
depth = float(first.z[first.values.argmax()] / (ds.contact_length[0] / 2))

print(f"largest von Mises stress: {ratio:.3f} of the peak pressure, {depth:.2f} radii deep")
assert abs(ratio - 0.620) < 0.005
assert abs(depth - 0.48) < 0.03
