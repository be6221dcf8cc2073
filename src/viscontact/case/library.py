"""Materials that a case file may give by name, each with its source."""

from __future__ import annotations

from typing import Any

# Both describe one PMMA, whose uniaxial relaxation modulus Spinu & Cerlinca (2018) take from
# Kumar & Narasimhan (2004): E(t) = 1428.57 + 184.15 exp(-t/8.989 s) + 190.71 exp(-t/117.97 s) MPa.
# Its exact inverse is the compliance of their eq. 15, which they use as it stands where the theory
# has Phi = 1/(2G). `pmma-paper` does so too; `pmma-kumar-2004` converts, Phi = (1 + nu) D.
MATERIALS: dict[str, dict[str, Any]] = {
    "pmma-paper": {
        "law": "creep-series",
        "instant": "5.545e-4 / MPa",
        "amplitudes": ["6.17e-5 / MPa", "8.38e-5 / MPa"],
        "times": ["10 s", "133.868808567604 s"],
        "data": "deviatoric",
        "poisson_ratio": 0.38,
    },
    "pmma-kumar-2004": {
        "law": "relaxation-series",
        "equilibrium": "1428.57 MPa",
        "moduli": ["184.15 MPa", "190.71 MPa"],
        "times": ["8.989 s", "117.97 s"],
        "data": "uniaxial",
        "poisson_ratio": 0.38,
    },
}
