"""
Pull-off between DMT and JKR
============================

How much a sphere holds depends on the Tabor number: the depth of the neck that the attraction pulls
up, over the range of the attraction. Stiff, small spheres with a long range hold
:math:`2 \\pi w R` (Derjaguin, Muller and Toporov), soft, large ones :math:`\\frac{3}{2} \\pi w R`
(Johnson, Kendall and Roberts). Which way between them, depends on the law of the attraction.
"""

# %%
# Four ranges, three laws
# -----------------------

import warnings

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc

radius, modulus, work = 10e-6, 1e6, 0.05  # [m], E* [Pa], [J/m²]
unit = np.pi * work * radius
length = np.cbrt(0.75 * np.pi * work * radius**2 / modulus)
depth = length**2 / radius
body = vc.Material(vc.Elastic(modulus / 4), poisson_ratio=0.5)
# Few cells lie across the cohesive zone, which a warning tells; they are enough here.
warnings.simplefilter("ignore", vc.AccuracyWarning)


def pull_off(law: str, tabor: float, cells: int = 56) -> float:
    """Largest pull of a sphere that is withdrawn from contact [π w R]."""
    reach = np.cbrt(radius * (work / modulus) ** 2) / tabor
    size = (6.5 if tabor > 0.5 else 11) * length
    found = vc.simulate(
        *(vc.Paraboloid(radius, radius), body, vc.ApproachHistory([0, 1], [0.0, -2.5 * depth])),
        *(vc.Grid((cells, cells), (size, size)), vc.uniform_times(1.0, 10)),
        adhesion=vc.Adhesion(work, range=reach, law=law),
        errors=False,
        fields="none",
    )
    return float(found.attrs["pull_off_force"] / unit)


tabors = np.array([0.15, 0.3, 0.6, 1.0])
laws = ("dugdale", "exponential", "lennard-jones")
pulls = {law: np.array([pull_off(law, each) for each in tabors]) for law in laws}

# %%
# The figure
# ----------

figure, axes = plt.subplots(figsize=(5.2, 3.6), layout="constrained")
numbers = np.geomspace(0.08, 4, 60)
theory = {
    each: -vc.reference.maugis_dugdale(
        radius, 1 / modulus, work, np.cbrt(radius * (work / modulus) ** 2) / each
    ).pull_off.force
    / unit
    for each in (*numbers, *tabors)
}
axes.semilogx(numbers, [theory[each] for each in numbers], "k", lw=1, label="Maugis 1992, Dugdale")
for (law, values), marker in zip(pulls.items(), "os^", strict=True):
    axes.plot(tabors, values, marker, mfc="none", label=law)
for level, name, side in ((2.0, "DMT", "bottom"), (1.5, "JKR", "top")):
    axes.axhline(level, color="0.6", lw=0.8, ls="--")
    axes.annotate(name, (4, level), ha="right", va=side, color="0.4")
axes.set(xlabel="Tabor number", ylabel="pull-off force over $\\pi w R$", ylim=(1.4, 2.1))
axes.legend(frameon=False, loc=(0.49, 0.53))

# %%
# The check
# ---------
#
# Dugdale's law has an exact solution. Every law lies between the two limits, and falls with the
# Tabor number.

error = pulls["dugdale"] / [theory[each] for each in tabors] - 1
print("errors of Dugdale's law:", ", ".join(f"{each:+.1%}" for each in error))
assert np.abs(error).max() < 0.02
assert all(
    (np.diff(each) < 0).all() and each.min() > 1.5 and each.max() < 2.0 for each in pulls.values()
)
