from .over_speed import OverSpeed

__all__ = [
    "OverSpeed",
]
