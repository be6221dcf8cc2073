from .of_state import CaseLeakage, leakage_memory, leakage_seconds

__all__ = [
    "CaseLeakage",
    "leakage_memory",
    "leakage_seconds",
]
