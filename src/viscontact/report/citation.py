"""How to cite the package, as CITATION.cff has it, which installed packages lack."""

#: Of the package: authors, title, version, licence.
PACKAGE = (
    "The viscontact developers: viscontact: contact of creeping bodies. Version {version}, MIT."
)
#: Of the paper that it grew from.
PAPER = (
    "Spinu, S.; Cerlinca, D.: Viscoelastic contact modelling: application to the finite length "
    "line contact. 2018."
)
