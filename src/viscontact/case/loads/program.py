"""Section of a load program: segments of mixed control that end on conditions."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import WithJsonSchema

from viscontact.case.errors import dotted
from viscontact.case.loads.base import Load
from viscontact.loads import LoadHistory, LoadProgram
from viscontact.loads.mixed import as_history
from viscontact.loads.program_sentences import FORMS, parsed_sentences

_SCHEMA = {
    "description": "what the instrument does in turn, such as " + ", ".join(map(repr, FORMS)),
    "anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}],
    "examples": [f"{FORMS[0]}; {FORMS[1]}"],
}


class Program(Load):
    """Segments that prescribe the force or the approach, each up to a duration or a condition."""

    kind: Literal["program"]
    sentences: Annotated[str | list[str], WithJsonSchema(_SCHEMA)]

    def build(self, area: float = 1.0) -> LoadHistory:
        """Return the history of the program, which awaits its events."""
        tail: dict[str, Any] = self._tail
        return as_history(LoadProgram(self._checked(), **tail))

    def _checked(self) -> list[str]:
        """Sentences that can be read; the key of one that cannot is named."""
        given = [self.sentences] if isinstance(self.sentences, str) else self.sentences
        for place, text in enumerate(given):
            try:
                parsed_sentences(text)
            except ValueError as error:
                is_list = isinstance(self.sentences, list)
                key = ("sentences", place) if is_list else ("sentences",)
                why = str(error).removeprefix("load program: ")
                raise ValueError(f"{dotted(key)}: {why}") from error
        return given
