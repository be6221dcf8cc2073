from . import adhesive_limits

__all__ = [
    "adhesive_limits",
]
