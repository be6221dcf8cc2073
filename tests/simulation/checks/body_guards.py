"""Guards of laws, strains and ends of bodies, each met by a run and missed by one."""

from __future__ import annotations

import numpy as np

import viscontact as vc
from simulation.checks.guarded_runs import (
    END,
    SLOPE,
    TABLE,
    WIDE,
    Guard,
    Job,
    NotAlwaysANumber,
    Shrinking,
    crowned,
    hertz_force,
    mapped,
    pressed_punch,
    rolled,
    round_bump,
)

BODY_GUARDS = {
    "a run beyond the last row of a table": Guard(
        vc.AccuracyWarning,
        "beyond 100 s, where the material's data end",
        met=Job(material=TABLE, load=vc.ramp(100.0, 20.0), times=np.linspace(0, 101, 30)),
        missed=Job(material=TABLE, load=vc.ramp(100.0, 20.0), times=np.linspace(0, 100, 30)),
    ),
    "a run beyond the data of one of two materials": Guard(
        vc.AccuracyWarning,
        "beyond 100 s, where the indenter material's data end",
        met=Job(indenter_material=TABLE, load=vc.ramp(100.0, 20.0), times=np.linspace(0, 101, 30)),
        missed=Job(
            indenter_material=TABLE, load=vc.ramp(100.0, 20.0), times=np.linspace(0, 100, 30)
        ),
    ),
    "a load sooner than the first row of a table": Guard(
        vc.AccuracyWarning,
        "at t = 0 s 100% of the load has come within less than 1 s",
        met=Job(material=TABLE, load=vc.step(100.0), times=np.linspace(0, 20, 30)),
        missed=Job(material=TABLE, load=vc.ramp(100.0, 20.0), times=np.linspace(0, 20, 30)),
    ),
    "a later jump sooner than the first row": Guard(
        vc.AccuracyWarning,
        "at t = 15 s 50% of the load has come within less than 1 s",
        met=Job(
            material=TABLE,
            load=vc.ForceHistory([0, 10, 15, 15], [0, 50, 50, 100]),
            times=np.linspace(0, 20, 41),
        ),
        missed=Job(
            material=TABLE,
            load=vc.ForceHistory([0, 10, 15, 15], [0, 90, 90, 100]),
            times=np.linspace(0, 20, 41),
        ),
    ),
    "a table that would gain energy": Guard(
        vc.AccuracyWarning,
        "a loss modulus of -13% of its modulus, and no material gains energy",
        met=Job(
            material=vc.Material(vc.TabulatedCreep([1, 10, 100], [1e-6, 3e-6, 1e-5]), 0.5),
            load=vc.ramp(100.0, 20.0),
            times=np.linspace(0, 100, 30),
        ),
        missed=Job(
            material=vc.Material(
                vc.TabulatedCreep([0, 1, 10, 100], [1e-6, 1.1e-6, 1.2e-6, 1.3e-6]), 0.5
            ),
            load=vc.ramp(100.0, 20.0),
            times=np.linspace(0, 100, 30),
        ),
    ),
    "a law that is no number": Guard(
        ValueError,
        "material: its law gives a contact compliance of nan /Pa",
        met=Job(material=vc.Material(NotAlwaysANumber(1e-6, 0.3, 1.0, 1e-7), 0.5), times=[0, 1]),
        missed=Job(
            material=vc.Material(NotAlwaysANumber(1e-6, 0.3, 1.0, 1e-7), 0.5),
            load=vc.step(100.0),
            times=np.linspace(0, 0.3, 31),
        ),
        besides=("time step",),
    ),
    "a law that takes creep back": Guard(
        ValueError,
        "never decrease",
        met=Job(material=vc.Material(Shrinking(1e-6, 0.3, 1.0, 1e-7), 0.5), times=[0, 1]),
        missed=Job(
            material=vc.Material(Shrinking(1e-6, 0.3, 1.0, 1e-7), 0.5),
            load=vc.step(100.0),
            times=np.linspace(0, 0.3, 31),
        ),
        besides=("time step",),
    ),
    "slopes": Guard(
        vc.AccuracyWarning,
        "slope within the contact reaches 0.32",
        met=round_bump(90 - np.degrees(np.arctan(0.32))),
        missed=round_bump(90 - np.degrees(np.arctan(0.28))),
        besides=("at a tip",),
    ),
    "a wide contact": Guard(
        vc.AccuracyWarning,
        "half width is 0.31 of the indenter's radius",
        met=Job(load=vc.step(hertz_force(0.31)), grid=vc.Grid((60, 60), (0.8, 0.8))),
        missed=Job(load=vc.step(hertz_force(0.29)), grid=vc.Grid((60, 60), (0.8, 0.8))),
    ),
    "a wide contact of a long roller": Guard(
        vc.AccuracyWarning,
        "half width is 0.3",
        met=rolled(half_width=0.33, half_length=10.0),
        missed=rolled(half_width=0.25, half_length=10.0),
        # By the logarithm of its length a line's approach is far more than local.
        besides=(END, "the approach"),
    ),
    "a wide contact of a roller shorter than that": Guard(
        vc.AccuracyWarning,
        "half width is 0.3",
        met=Job(vc.Roller(1.0, 0.1), vc.step(1.4e5), vc.Grid((24, 40), (0.24, 0.9))),
        missed=Job(vc.Roller(1.0, 0.1), vc.step(5e4), vc.Grid((24, 40), (0.24, 0.9))),
        besides=(END,),
    ),
    "a deep approach": Guard(
        vc.AccuracyWarning,
        "the approach is 0.1 of the indenter's radius",  # 0.104
        met=Job(load=vc.step(approach=0.104), grid=vc.Grid((60, 60), (0.9, 0.9))),
        missed=Job(load=vc.step(approach=0.098), grid=vc.Grid((60, 60), (0.9, 0.9))),
        besides=(SLOPE, WIDE),
    ),
    "a flat punch pressed deep": Guard(
        vc.AccuracyWarning,
        "the approach is 0.6 of the contact's half width",
        met=pressed_punch(0.6),
        missed=pressed_punch(0.4),
        besides=(END,),
    ),
    "contact at a profile's end": Guard(
        vc.AccuracyWarning,
        END,
        met=Job(vc.Roller(1.0, 0.05), vc.step(2e3), vc.Grid((32, 32), (0.2, 0.2))),
        missed=Job(crowned, vc.step(2e3), vc.Grid((40, 40), (0.4, 0.2))),
    ),
    "contact at a map's edge": Guard(
        vc.AccuracyWarning,
        END,
        met=Job(mapped(0.09, 0.001), grid=vc.Grid((60, 60), (0.28, 0.28))),
        missed=Job(mapped(0.12, 0.001), grid=vc.Grid((60, 60), (0.28, 0.28))),
    ),
    "an end face beside the contact": Guard(
        vc.AccuracyWarning,
        "the indenter ends within a half width of the contact",
        # Both give alike, so that half of each makes the contact of J.
        met=Job(
            mapped(0.18, 0.001),
            grid=vc.Grid((70, 70), (0.5, 0.5)),
            material=vc.Material(vc.Elastic(2e6), 0.5),
            indenter_material=vc.Material(vc.Elastic(2e6), 0.5),
        ),
        missed=Job(
            mapped(0.22, 0.001),
            grid=vc.Grid((70, 70), (0.5, 0.5)),
            material=vc.Material(vc.Elastic(2e6), 0.5),
            indenter_material=vc.Material(vc.Elastic(2e6), 0.5),
        ),
    ),
    "an end face of a rigid body": Guard(
        vc.AccuracyWarning,
        END,  # and nothing else: a rigid body has no half-space that goes on
        met=Job(mapped(0.09, 0.001), grid=vc.Grid((70, 70), (0.5, 0.5))),
        missed=Job(mapped(0.18, 0.001), grid=vc.Grid((70, 70), (0.5, 0.5))),
    ),
    "a thin half-space": Guard(
        vc.AccuracyWarning,
        "half width is 0.2 of the body's thickness of 490 mm",
        met=Job(material=vc.Material(vc.Elastic(1e6), 0.5, thickness=0.49)),
        missed=Job(material=vc.Material(vc.Elastic(1e6), 0.5, thickness=0.51)),
    ),
    "a thin indenter": Guard(
        vc.AccuracyWarning,
        "half width is 0.21 of the body's thickness of 480 mm",
        met=Job(
            material=vc.Material(vc.Elastic(2e6), 0.5, thickness=1.0),
            indenter_material=vc.Material(vc.Elastic(2e6), 0.5, thickness=0.48),
        ),
        missed=Job(
            material=vc.Material(vc.Elastic(2e6), 0.5, thickness=1.0),
            indenter_material=vc.Material(vc.Elastic(2e6), 0.5, thickness=0.51),
        ),
    ),
}
