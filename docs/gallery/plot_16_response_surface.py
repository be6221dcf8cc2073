"""
A response surface of 100 runs
==============================

One command computes a ball under ten forces on ten materials. ``open_many`` returns all runs as one
dataset, whose dimensions are the varied keys.
"""

# %%
# One command, 100 runs
# ---------------------
#
# The values behind each ``--vary`` are separated by commas. In a shell the command is
# ``viscontact run ball.yaml --vary load.force=1N,2N,... --vary material.delayed_modulus=... -j 2 -o
# surface``; ``viscontact status surface --watch`` shows its progress in another terminal.

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import viscontact as vc

CASE = """
title: Ball on a standard linear solid
indenter: {shape: paraboloid, radius_x: 10 mm, radius_y: 10 mm}
material:
  law: zener
  shear_modulus: 10 MPa
  delayed_modulus: 10 MPa
  viscosity: 10 MPa s
  poisson_ratio: 0.5
load: {kind: step, force: 1 N}
time: {end: 100 s, steps: 2, spacing: log, first: 10 s}
grid: {shape: [48, 48], size: [5 mm, 5 mm]}
output: {fields: none, errors: false}
"""

folder = Path(tempfile.mkdtemp())
(folder / "ball.yaml").write_text(CASE, encoding="utf-8")
forces = ",".join(f"{force:.3g}N" for force in np.linspace(1.0, 10.0, 10))
moduli = ",".join(f"{modulus:.3g}MPa" for modulus in np.geomspace(4.0, 40.0, 10))
vary = ["--vary", f"load.force={forces}", "--vary", f"material.delayed_modulus={moduli}"]
words = ["run", "ball.yaml", *vary, "-j", "2", "-o", "surface", "--quiet"]
subprocess.run([sys.executable, "-m", "viscontact", *words], cwd=folder, check=True)

# %%
# One dataset
# -----------
#
# Without error bars, as here, a run takes a third of the time. The figure shows the largest values
# over time; each dot is a run.

ds = vc.open_many(folder / "surface")
print(dict(ds.approach.sizes))
figure = vc.plot.response(ds)

# %%
# The check: after a long time the material is elastic with the modulus of both springs in series,
# and the approach follows Hertz (Johnson, Contact Mechanics, eq. 4.23), on all of the surface.

delayed = ds["material.delayed_modulus"]
modulus = 1 / (1 / 10e6 + 1 / delayed)  # shear
hertz = (9 * ds["load.force"] ** 2 / (16 * 0.01 * (4 * modulus) ** 2)) ** (1 / 3)
difference = abs(ds.approach.isel(time=-1) / hertz - 1)
print(f"largest difference from Hertz: {float(difference.max()):.2%}")
assert float(difference.max()) < 0.01
