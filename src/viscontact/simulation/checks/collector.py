"""Collection of accuracy warnings: each kind is issued once."""

from __future__ import annotations

from dataclasses import field

from viscontact.backend.lazy_dataclass import dataclass


@dataclass
class WarningCollector:
    """Accuracy warnings by kind, each issued once."""

    issued: dict[str, str] = field(default_factory=dict)  # sentences issued so far, by kind

    def new(self, *found: dict[str, str]) -> tuple[str, ...]:
        """Keep the sentences of kinds that have not been issued yet, and return them."""
        fresh = {
            kind: text
            for warnings in found
            for kind, text in warnings.items()
            if kind not in self.issued
        }
        self.issued.update(fresh)
        return tuple(fresh.values())
