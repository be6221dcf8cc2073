"""
A measured surface
==================

A ball with a rough surface is pressed on PMMA within a second, and the load is held for a quarter
of an hour. The first contact is at the peaks. As the force rises, the contact spots grow and merge.
As the PMMA creeps, the contact grows further, and the valley inside it that is not in contact
shrinks.
"""

# %%
# From the file to the body
# -------------------------
#
# The example uses a height map that is shipped with the package (128 × 128 points, 1 µm apart; it
# is synthetic, not measured). Indenters can be added: this one is a ball plus the map. ``levelled``
# removes the tilt of the measurement.

import warnings
from importlib.resources import as_file, files

import numpy as np

import viscontact as vc
from viscontact import plot, surfaces

with as_file(files("viscontact.case.examples") / "rough-patch.npz") as path:
    surface = vc.read_surface(path)
print(surface)

ball = vc.Sphere(2e-3) + surfaces.indenter_of(surfaces.levelled(surface))

# %%
# The run
# -------
#
# The grid points are those of the map. The surface is not known at a finer scale, so the highest
# pressure peaks depend on the mesh; the warning about this is switched off.

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
# The figures
# -----------
#
# The outline of the contact: two spots when the force begins to rise, one patch with an open valley
# under the full force, and a larger patch with a smaller valley after 1000 s.

times = ds.field_time.values  # the stored instants
figure = plot.contact_outline(ds, times=times)

# %%
# The pressure: highest on the peaks.

figure = plot.pressure_map(ds, times=times[1:])

# %%
# The check
# ---------
#
# While a contact only grows, the approach on a creeping body is that on an elastic body with the
# current creep compliance, for any shape (Lee & Radok 1960): one elastic step gives the approach of
# the whole run. The ramp takes one second, so the compliance is a mean over the last second.

lags = np.linspace(999.0, 1000.0, 11)
compliance = float(np.trapezoid(pmma.contact_compliance()(lags), lags))
elastic = vc.Material(vc.Elastic((1 - 0.3) / (2 * compliance)), poisson_ratio=0.3)
elastic_ds = vc.simulate(ball, elastic, vc.step(60e-3), grid, [0.0], fields="none", errors=False)

ours, theirs = float(ds.approach[-1]), float(elastic_ds.approach[0])
print(f"approach after 1000 s: {ours * 1e9:.3f} nm, elastic body {theirs * 1e9:.3f} nm")
assert abs(ours / theirs - 1) < 1e-4

# The resultant of the pressure is the load.
carried = float(ds.pressure[-1].sum() * grid.cell_area)
assert abs(carried / 60e-3 - 1) < 1e-5
# sphinx_gallery_thumbnail_number = 2
