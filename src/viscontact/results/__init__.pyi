from .enlarged_grid import enlargements

__all__ = [
    "enlargements",
]
