"""Collect each kind of warning once."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass
class WarningCollector:
    """Each kind of doubt once: what has been said already, and what is new."""

    said: dict[str, str] = field(default_factory=dict)

    def new(self, *found: dict[str, str]) -> tuple[str, ...]:
        """Keep what has not been said, and return it.

        Parameters
        ----------
        *found : dict of str to str
            Sentences by kind of doubt.

        Returns
        -------
        tuple of str
            The sentences of kinds met for the first time.
        """
        fresh = {
            kind: text
            for warnings in found
            for kind, text in warnings.items()
            if kind not in self.said
        }
        self.said.update(fresh)
        return tuple(fresh.values())
