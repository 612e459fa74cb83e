"""Reads messages.toml, checks it and gives it a hash."""

from __future__ import annotations

import json
import tomllib
import zlib
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

SOURCE = Path(__file__).with_name("messages.toml")

WIRE_BYTES = {"u8": 1, "i8": 1, "u16": 2, "i16": 2, "u32": 4, "i32": 4}
"""Bytes of each wire type."""

HEADER_BYTES = 4
"""Of a frame: length, type, seq, ack."""

CRC_BYTES = 2

COBS_BYTES = 2
"""What the encoding adds to a frame: one code byte and the delimiter."""

WireType = Literal["u8", "i8", "u16", "i16", "u32", "i32"]
FieldName = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]*$")]
TypeName = Annotated[str, Field(pattern=r"^[A-Z][A-Za-z0-9]*$")]
ConstantName = Annotated[str, Field(pattern=r"^[A-Z][A-Z0-9_]*$")]


class Part(BaseModel):
    """Base of all parts of the definition: a misspelt key is an error."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class Constant(Part):
    """A number both sides know."""

    value: int
    text: str


class MessageField(Part):
    """One field of a message, or an array of ``count`` equal ones."""

    name: FieldName
    type: WireType
    count: Annotated[int, Field(ge=1)] = 1
    unit: str = ""
    enum: str = ""
    text: str

    @property
    def size_bytes(self) -> int:
        """Bytes on the wire."""
        return WIRE_BYTES[self.type] * self.count


class MessageDefinition(Part):
    """One message."""

    name: TypeName
    type: Annotated[int, Field(ge=1, le=255)]
    sender: Literal["host", "board"] = Field(alias="from")
    sequenced: bool = False
    text: str
    fields: tuple[MessageField, ...]

    @property
    def size_bytes(self) -> int:
        """Bytes of the payload."""
        return sum(field.size_bytes for field in self.fields)

    @property
    def constant(self) -> str:
        """Name in capitals: ``HelloRequest`` is ``HELLO_REQUEST``."""
        return "".join(f"_{c}" if c.isupper() and i else c.upper() for i, c in enumerate(self.name))


class Names(Part):
    """Named numbers: the values of an enumeration, or the bits of a set of flags."""

    text: str
    values: dict[ConstantName, Annotated[int, Field(ge=0, le=255)]]

    @model_validator(mode="before")
    @classmethod
    def _split(cls, table: dict[str, Any]) -> dict[str, Any]:
        values = {name: value for name, value in table.items() if name != "text"}
        return {"text": table["text"], "values": values}

    @model_validator(mode="after")
    def _unique(self) -> Self:
        if len(set(self.values.values())) != len(self.values):
            raise ValueError("two names have the same number")
        return self


class ProtocolDefinition(Part):
    """The whole protocol."""

    constants: dict[ConstantName, Constant]
    enums: dict[TypeName, Names]
    flags: dict[TypeName, Names]
    messages: tuple[MessageDefinition, ...]

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        for what, values in (
            ("name", [message.name for message in self.messages]),
            ("type", [message.type for message in self.messages]),
        ):
            if len(set(values)) != len(values):
                raise ValueError(f"two messages have the same {what}")
        largest = self.constants["MAX_FRAME_BYTES"].value - COBS_BYTES - HEADER_BYTES - CRC_BYTES
        for message in self.messages:
            if message.size_bytes > largest:
                raise ValueError(
                    f"{message.name} has {message.size_bytes} bytes; {largest} fit into a frame"
                )
            names = [field.name for field in message.fields]
            if len(set(names)) != len(names):
                raise ValueError(f"two fields of {message.name} have the same name")
            unknown = {field.enum for field in message.fields} - {"", *self.enums}
            if unknown:
                raise ValueError(f"{message.name} speaks of unknown enums: {sorted(unknown)}")
            if message.sequenced and message.sender != "host":
                raise ValueError(f"{message.name}: only the host's messages are sequenced")
        return self

    @cached_property
    def hash(self) -> int:
        """CRC-32 over all that matters on the wire; explanations do not change it."""
        meaning = self.model_dump(by_alias=True)
        text = json.dumps(_without_texts(meaning), sort_keys=True, separators=(",", ":"))
        return zlib.crc32(text.encode())


def _without_texts(part: Any) -> Any:  # noqa: ANN401 - any JSON value
    if isinstance(part, dict):
        return {key: _without_texts(value) for key, value in part.items() if key != "text"}
    if isinstance(part, list | tuple):
        return [_without_texts(value) for value in part]
    return part


def load_definition(source: Path = SOURCE) -> ProtocolDefinition:
    """Read and check the definition.

    Raises:
        pydantic.ValidationError: it contradicts itself.
    """
    return ProtocolDefinition.model_validate(tomllib.loads(source.read_text(encoding="utf-8")))
