from . import separation, shear_terms

__all__ = [
    "separation",
    "shear_terms",
]
