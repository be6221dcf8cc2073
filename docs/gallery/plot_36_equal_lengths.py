"""
A roller on a track of its own length
=====================================

Where roller and track end at the same plane, the pressure falls towards the end if the material
widens under pressure, and is uniform if it does not. A half-space, which goes on beyond the roller,
gives a peak there instead: it has the wrong sign. ``vc.Body`` gives the track its ends, each a
plane free of stress.
"""

# %%
# Three Poisson's ratios
# ----------------------
#
# Load per length and E/(1 - ν²) are the same, so that a long contact has the same width in all
# runs. The grid has two rows of cells beyond each end, which must be a border of cells.

import warnings

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc

# Between two free ends the approach has no datum, which each run says.
warnings.filterwarnings("ignore", category=vc.AccuracyWarning)

radius, length, line = 10e-3, 4e-3, 10e3  # [m, m, N/m]
roller = vc.Roller(radius, half_length=length / 2)
cells = 80
grid = vc.Grid((cells + 4, 48), (length * (1 + 4 / cells), 0.8e-3))
load = vc.step(line * length)


def track(ratio: float) -> vc.Material:
    """Material of one contact modulus E/(1 - ν²)."""
    return vc.Material(
        vc.Elastic.from_uniaxial(2e9 * (1 - ratio**2), poisson_ratio=ratio), poisson_ratio=ratio
    )


ratios = {0.0: "#440154", 0.3: "#21918c", 0.5: "#d98c00"}
ended = {
    ratio: vc.simulate(roller, vc.Body(track(ratio), length), load, grid, [0.0], errors=False)
    for ratio in ratios
}
endless = vc.simulate(roller, track(0.3), load, grid, [0.0], errors=False)

# %%
# The line load
# -------------
#
# Force per length, over its mean. The half-space does not know Poisson's ratio but for E/(1 - ν²).

figure, axes = plt.subplots(figsize=(6, 3.4), layout="constrained")
inside = np.abs(grid.x) < length / 2
for ratio, colour in ratios.items():
    over_mean = ended[ratio].line_load[0][inside] / line
    axes.plot(grid.x[inside] * 1e3, over_mean, color=colour, label=f"free ends, ν = {ratio:g}")
over_mean = endless.line_load[0][inside] / line
axes.plot(grid.x[inside] * 1e3, over_mean, color="0.5", linestyle="--", label="half-space")
for end in (-length / 2, length / 2):
    axes.axvline(end * 1e3, color="0.2", linewidth=0.8)
axes.set(xlabel="x [mm]", ylabel="line load / mean [-]", ylim=(0, 3), xlim=(-2.1, 2.1))
legend = axes.legend(frameon=False, loc="upper center")

# %%
# Below the end
# -------------
#
# Von Mises stress along the track, below the middle of the contact. At a free end the material is
# not held along x, and is stressed more than in the middle, though the pressure is lower there: at
# its surface for ν = 0.3, below it for ν = 0.5. Beyond the end there is no body, and no stress.

figure, panels = plt.subplots(2, 1, figsize=(6, 3.8), sharex=True, layout="constrained")
for axes, ratio in zip(panels, (0.3, 0.5), strict=True):
    inside_track = vc.section_stresses(ended[ratio], np.linspace(0.0, 0.6e-3, 41), y=0.0)
    stress = inside_track.von_mises[0] / 1e6
    filled = axes.contourf(stress.x * 1e3, stress.z * 1e3, stress, levels=12, cmap="viridis")
    figure.colorbar(filled, ax=axes, label="von Mises [MPa]")
    axes.set(ylabel="depth [mm]", xlim=(-2.1, 2.1), ylim=(0.6, 0), title=f"ν = {ratio:g}")
    at_end = vc.section_stresses(ended[ratio], [0.1e-3], x=length / 2)
    left = float(np.abs(at_end.stress_xx).max() / ended[ratio].peak_pressure[0])
    assert left < 1e-4
text = panels[-1].set_xlabel("x [mm]")

# %%
# Off the middle
# --------------
#
# A force that acts 0.3 mm off the middle loads that end more, but even there the pressure falls to
# the free end. Its tilt has no datum, as the body below bends as a plate does.

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
for offset, colour in ((0.0, "#21918c"), (0.15e-3, "#3b528b"), (0.3e-3, "#440154")):
    pressed = vc.step(line * length, eccentricity_x=offset)
    ds = vc.simulate(roller, vc.Body(track(0.3), length), pressed, grid, [0.0], errors=False)
    name = f"{offset * 1e3:g} mm off"
    axes.plot(grid.x[inside] * 1e3, ds.line_load[0][inside] / line, color=colour, label=name)
    assert abs(float(ds.eccentricity_x[0]) - offset) < 1e-9
for end in (-length / 2, length / 2):
    axes.axvline(end * 1e3, color="0.2", linewidth=0.8)
axes.set(xlabel="x [mm]", ylabel="line load / mean [-]", ylim=(0, 1.5), xlim=(-2.1, 2.1))
legend = axes.legend(frameon=False, loc="lower center")

# %%
# A crowned roller on a short track
# ---------------------------------
#
# Where the roller is longer than the track, it is the track that ends, and its line load is that of
# equal lengths. A crown lifts the roller off the ends of the track.

figure, axes = plt.subplots(figsize=(6, 3), layout="constrained")
for crown, colour in ((None, "#440154"), (1.0, "#21918c"), (0.3, "#d98c00")):
    long_roller = vc.Roller(radius, half_length=length, profile="full", crown_radius=crown or 1e6)
    ds = vc.simulate(long_roller, vc.Body(track(0.3), length), load, grid, [0.0], errors=False)
    name = "straight" if crown is None else f"crown of {crown:g} m"
    axes.plot(grid.x[inside] * 1e3, ds.line_load[0][inside] / line, color=colour, label=name)
for end in (-length / 2, length / 2):
    axes.axvline(end * 1e3, color="0.2", linewidth=0.8)
axes.set(xlabel="x [mm]", ylabel="line load / mean [-]", ylim=(0, 1.5), xlim=(-2.1, 2.1))
legend = axes.legend(frameon=False, loc="lower center")

# %%
# The check
# ---------
#
# Without Poisson's effect nothing acts along x: each slice is a line contact of Hertz, in plane
# strain and in plane stress at once.

exact = vc.reference.hertz_line(line, radius, 2e9)
uniform = ended[0.0]
largest = float(np.abs(uniform.line_load[0][inside] / line - 1).max())
peak = float(uniform.peak_pressure[0])
print(f"line load differs from its mean by {largest:.1e} at most")
print(f"peak pressure {peak / 1e6:.3f} MPa, Hertz {exact.peak_pressure / 1e6:.3f} MPa")
assert largest < 2e-5
assert abs(peak / exact.peak_pressure - 1) < 3e-3
# sphinx_gallery_thumbnail_number = 1
