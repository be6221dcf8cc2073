"""
Many runs in parallel
=====================

A parameter study consists of many independent runs. ``simulate_many`` distributes them to the
cores; each result is bit-identical to that of a single run.
"""

# %%
# Five forces
# -----------
#
# Each run is a mapping of the arguments of ``simulate``. Each new process first imports the script,
# so the call must be inside ``if __name__ == "__main__"``; a notebook does not need this line.

import matplotlib.pyplot as plt
import numpy as np

import viscontact as vc

forces = [1.0, 2.0, 4.0, 8.0, 16.0]
rubber = vc.Material(vc.Zener(1e6, 0.5e6, 10e6), poisson_ratio=0.5)
recipes = [
    {
        "indenter": vc.Paraboloid(0.02, 0.02),
        "material": rubber,
        "load": vc.step(force),
        "grid": vc.Grid((64, 64), (0.022, 0.022)),
        "times": vc.log_times(0.5, 200.0, 24),
        "fields": "none",
    }
    for force in forces
]

if __name__ == "__main__":
    runs = vc.simulate_many(recipes, workers=2)

    figure, axes = plt.subplots(figsize=(4.8, 3.2), layout="constrained")
    for index, label, colour in ((0, "after 0 s", "#440154"), (-1, "after 200 s", "#d98c00")):
        approach = np.array([float(ds.approach[index]) for ds in runs])
        axes.loglog(forces, approach * 1e3, "o", color=colour, label=label)
        # A line of slope 2/3 through the first point.
        line = approach[0] * (np.array(forces) / forces[0]) ** (2 / 3)
        axes.loglog(forces, line * 1e3, "-", color=colour, linewidth=0.8)
    axes.set(xlabel="force [N]", ylabel="approach [mm]")
    axes.set_xticks(forces, [f"{force:g}" for force in forces], minor=False)
    axes.set_yticks([0.1, 0.2, 0.5, 1, 2], ["0.1", "0.2", "0.5", "1", "2"], minor=False)
    axes.minorticks_off()
    axes.legend(frameon=False)

    # The check: at every instant, the approach of a ball is proportional to the force to the power
    # of 2/3 (Hertz).
    last = [float(ds.approach[-1]) for ds in runs]
    exponent = np.polyfit(np.log(forces), np.log(last), 1)[0]
    print(f"exponent after 200 s: {exponent:.4f}, Hertz 0.6667")
    assert abs(exponent - 2 / 3) < 2e-3
