"""Choice of a section by the key that names its kind."""

from __future__ import annotations

from functools import cached_property
from typing import Annotated, Any, get_args

from pydantic import (
    BaseModel,
    Field,
    GetCoreSchemaHandler,
    GetJsonSchemaHandler,
    TypeAdapter,
    ValidationInfo,
)
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, SchemaValidator, core_schema


class ChosenBy:
    """Annotation of a union of sections, of which a key chooses one."""

    # As pydantic's ``Field(discriminator=...)``, but validators are built for those sections only
    # that occur in a case.

    def __init__(self, discriminator: str) -> None:
        self.discriminator = discriminator
        self._union: Any = None
        self._validators: dict[str, SchemaValidator] = {}

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """Return the pydantic schema, which validates the chosen section."""
        self._union = source
        return core_schema.with_info_plain_validator_function(self._validate)

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Return the JSON schema of the union."""
        return handler(self._union_adapter.core_schema)

    def _validate(self, given: Any, info: ValidationInfo) -> Any:
        key = self.discriminator
        name = given.get(key) if isinstance(given, dict) else getattr(given, key, None)
        if not isinstance(name, str) or name not in self._sections:
            return self._union_adapter.validate_python(given, context=info.context)  # refuses it
        if name not in self._validators:
            self._validators[name] = _validator_of(self._sections[name], name, key)
        return self._validators[name].validate_python(given, context=info.context)

    @cached_property
    def _union_adapter(self) -> TypeAdapter[Any]:
        union: Any = Annotated[self._union, Field(discriminator=self.discriminator)]
        return TypeAdapter(union)

    @cached_property
    def _sections(self) -> dict[str | int, type[BaseModel]]:
        return alternatives(Annotated[self._union, self])


def _validator_of(section: type[BaseModel], name: str, key: str) -> SchemaValidator:
    """Validator of a union of a single section: locations of errors contain its name."""
    section.model_rebuild()
    only = {name: section.__pydantic_core_schema__}
    return SchemaValidator(core_schema.tagged_union_schema(only, key, from_attributes=True))


def alternatives(union: Any) -> dict[str | int, type[BaseModel]]:
    """Sections of a discriminated union by the values of the key that distinguishes them."""
    sections, choice, *_ = get_args(union)
    return {
        name: section
        for section in get_args(sections)
        for name in get_args(section.model_fields[choice.discriminator].annotation)
    }
