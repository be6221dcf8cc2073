"""Keywords of the materials of Abaqus: which are read, and which end the materials of a model.

Abaqus 2016 Analysis User's Guide, section 1.2.1, "Input syntax rules": blanks are ignored, and a
word needs only as many characters as distinguish it from others.
"""

from __future__ import annotations

from viscontact.bodies.materials.cards import time_dependence

TEST_DATA = ("SHEAR TEST DATA", "VOLUMETRIC TEST DATA", "COMBINED TEST DATA")
READ = ("ELASTIC", "VISCOELASTIC", "TRS", *TEST_DATA)
#: Keywords that end the materials of a whole model.
BEYOND = ("STEP", "PART", "ASSEMBLY", "NODE", "ELEMENT", "BOUNDARY", "SURFACE INTERACTION",
          "INITIAL CONDITIONS", "SOLID SECTION", "END PART", "END ASSEMBLY", "CONNECTOR BEHAVIOR",
          "GASKET BEHAVIOR", "AMPLITUDE")  # fmt: skip
#: Keywords of materials that are noted, and those of which others are the beginning.
NOTED = (
    *("ACOUSTIC MEDIUM", "ANNEAL TEMPERATURE", "BIAXIAL TEST DATA", "BRITTLE CRACKING"),
    *("BRITTLE FAILURE", "BRITTLE SHEAR", "CAP HARDENING", "CAP PLASTICITY", "CAST IRON"),
    *("CAST IRON PLASTICITY", "CLAY HARDENING", "CLAY PLASTICITY", "CONCRETE", "CONDUCTIVITY"),
    *("CRUSHABLE FOAM", "CRUSHABLE FOAM HARDENING", "CYCLED PLASTIC", "CYCLIC HARDENING"),
    *("DAMAGE EVOLUTION", "DAMAGE INITIATION", "DAMAGE STABILIZATION", "DAMPING", "DENSITY"),
    *("DEFORMATION PLASTICITY", "DEPVAR", "DIELECTRIC", "DIFFUSIVITY", "DRUCKER PRAGER"),
    *("DRUCKER PRAGER HARDENING", "ELECTRICAL CONDUCTIVITY", "EOS", "EXPANSION", "FAIL STRAIN"),
    *("FAIL STRESS", "GEL", "HEAT GENERATION", "HYPERELASTIC", "HYPERFOAM", "HYPOELASTIC"),
    *("INELASTIC HEAT FRACTION", "JOULE HEAT FRACTION", "LATENT HEAT", "MOHR COULOMB"),
    *("MOISTURE SWELLING", "MULLINS EFFECT", "NO COMPRESSION", "NO TENSION", "ORNL"),
    *("PERMEABILITY", "PIEZOELECTRIC", "PLANAR TEST DATA", "PLASTIC", "POROUS ELASTIC"),
    *("POTENTIAL", "RATIOS", "REINFORCEMENT", "SHEAR FAILURE", "SHEAR RETENTION"),
    *("SIMPLE SHEAR TEST DATA", "SOLUBILITY", "SORPTION", "SPECIFIC HEAT", "TENSILE FAILURE"),
    *("TENSION STIFFENING", "TRIAXIAL TEST DATA", "UNIAXIAL TEST DATA", "USER MATERIAL"),
    *("USER DEFINED FIELD", "VISCO"),
)
_KNOWN = {
    word.replace(" ", ""): word
    for word in (
        *("MATERIAL", "INCLUDE", "PHYSICAL CONSTANTS"),
        *(*READ, *BEYOND, *NOTED, *time_dependence.ABAQUS),
    )
}


def whole_keyword(written: str) -> str:
    """Return the keyword in capitals that an abbreviated one stands for; itself if unknown."""
    plain = _plain(written)
    meant = meanings(written)
    if plain in _KNOWN or len(meant) == 1:
        return _KNOWN.get(plain, meant[0])
    return " ".join(written.split()).upper()


def meanings(written: str) -> list[str]:
    """Return the keywords of materials of which one is the beginning."""
    return [word for key, word in _KNOWN.items() if key.startswith(_plain(written))]


def _plain(written: str) -> str:
    return "".join(written.split()).upper()
