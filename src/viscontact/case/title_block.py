"""Section `report` of a case file."""

from __future__ import annotations

from pydantic import Field

from viscontact.case.quantities import Section


class TitleBlock(Section):
    """Title block of the report, stored with the result."""

    project: str = Field(default="", description="project that the run belongs to")
    operator: str = Field(default="", description="person who is responsible for the run")
    revision: str = Field(default="", description="revision of the case", examples=["B"])

    @property
    def entries(self) -> dict[str, str]:
        """The entries that are given, by name."""
        return {name: value for name, value in self.model_dump().items() if value}
