"""
A measured surface
==================

A ball with a rough surface is pressed on PMMA within a second and left there for a quarter of an
hour. It touches where its peaks are. As the force rises the spots grow and join; as the PMMA creeps
the contact spreads on, and its pit shrinks.
"""

# %%
# From the file to the body
# -------------------------
#
# The map that is shipped with the package stands for one's own (128 × 128 points, 1 µm apart; it
# was made by a computer, not measured). Indenters add up: this one is a ball with the map on it.
# ``levelled`` takes off the tilt in which a map was measured.

import warnings
from importlib.resources import as_file, files

import numpy as np

import viscontact as vc
from viscontact import plot, surfaces

with as_file(files("viscontact.examples") / "rough-patch.npz") as path:
    surface = vc.read_surface(path)
print(surface)

ball = vc.Sphere(2e-3) + surfaces.indenter_of(surfaces.levelled(surface))

# %%
# The run
# -------
#
# The grid's points are those of the map. A map is known no finer than that, so the highest peaks of
# pressure depend on the mesh; the run would warn of it.

warnings.simplefilter("ignore", vc.AccuracyWarning)
pmma = vc.shipped_material("pmma-kumar-2004")
grid = vc.Grid((120, 120), (120e-6, 120e-6))
ds = vc.simulate(
    ball,
    pmma,
    vc.ramp(60e-3, duration=1.0),
    grid,
    vc.log_times(0.01, 1000.0, 21),
    fields=[0.01, 1.0, 1000.0],
    errors=False,
)

# %%
# The pictures
# ------------
#
# The outline of the contact: two spots when the force begins to rise, one patch with a pit under
# all of it, and a wider patch with a smaller pit after 1000 s.

times = ds.field_time.values  # of the instants stored
figure = plot.contact_outline(ds, times=times)

# %%
# The pressure: highest on the peaks.

figure = plot.pressure_map(ds, times=times[1:])

# %%
# The check
# ---------
#
# While a contact only grows, a creeping body answers like an elastic one of the compliance that it
# has by then, whatever the shape (Lee & Radok 1960): one elastic step gives the approach that the
# march has come to. The ramp took a second, so the compliance is a mean over its last second.

lags = np.linspace(999.0, 1000.0, 11)
compliance = np.trapezoid(pmma.contact_compliance()(lags), lags)
elastic = vc.Material(vc.Elastic((1 - 0.3) / (2 * compliance)), poisson_ratio=0.3)
twin = vc.simulate(ball, elastic, vc.step(60e-3), grid, [0.0], fields="none", errors=False)

ours, theirs = float(ds.approach[-1]), float(twin.approach[0])
print(f"approach after 1000 s: {ours * 1e9:.3f} nm, of the elastic twin {theirs * 1e9:.3f} nm")
assert abs(ours / theirs - 1) < 1e-4

# The pressures carry the load.
carried = float(ds.pressure[-1].sum() * grid.cell_area)
assert abs(carried / 60e-3 - 1) < 1e-5
# sphinx_gallery_thumbnail_number = 2
