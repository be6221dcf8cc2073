from .cases import demo, example, schema
from .designing import design
from .drawing import compare, plot
from .fitting import fit
from .heating import heat
from .installation import cite, doctor
from .leaking import leakage
from .materials import material
from .running import check, run
from .sensing import sensitivity
from .serving import serve
from .showing import export, report, show, verify
from .sweeps import collect, status
from .theories import theory

__all__ = [
    "check",
    "cite",
    "collect",
    "compare",
    "demo",
    "design",
    "doctor",
    "example",
    "export",
    "fit",
    "heat",
    "leakage",
    "material",
    "plot",
    "report",
    "run",
    "schema",
    "sensitivity",
    "serve",
    "show",
    "status",
    "theory",
    "verify",
]
