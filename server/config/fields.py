"""The settings as fields of a form: what each is, what it may be, where it can be changed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any, Literal

from server.config.settings import Settings

Kind = Literal["number", "integer", "boolean", "text", "choice", "other"]

_KINDS: Mapping[str, Kind] = {
    "number": "number",
    "integer": "integer",
    "boolean": "boolean",
    "string": "text",
}
_LEAST = ("minimum", "exclusiveMinimum")
_MOST = ("maximum", "exclusiveMaximum")


@dataclass(frozen=True, slots=True)
class SettingField:
    """One setting.

    Attributes:
        key: Dotted, such as webhooks.timeout_s.
        kind: Of its value; "other" is a list or a table.
        words: What it is for.
        optional: It may be left empty.
        choices: The only values, if there are few.
        least: Smallest number, or just above it.
        most: Largest number, or just below it.
    """

    key: str
    kind: Kind
    words: str
    optional: bool
    choices: tuple[str, ...]
    least: float | None
    most: float | None


@cache
def setting_fields() -> tuple[SettingField, ...]:
    """All settings, section by section."""
    schema = Settings.model_json_schema()
    return tuple(_fields(schema, schema.get("$defs", {}), ""))


def _fields(
    table: Mapping[str, Any], tables: Mapping[str, Any], above: str
) -> Iterator[SettingField]:
    for name, given in table.get("properties", {}).items():
        key = f"{above}.{name}" if above else name
        schema = _resolved(given, tables)
        if schema.get("properties"):
            yield from _fields(schema, tables, key)
        else:
            yield _field(key, given, schema, tables)


def _field(
    key: str, given: Mapping[str, Any], schema: Mapping[str, Any], tables: Mapping[str, Any]
) -> SettingField:
    options = [_resolved(each, tables) for each in schema.get("anyOf", [schema])]
    wanted = [each for each in options if each.get("type") != "null"]
    only = wanted[0] if len(wanted) == 1 else {}
    choices = tuple(str(each) for each in only.get("enum", ()))
    return SettingField(
        key=key,
        kind="choice" if choices else _KINDS.get(only.get("type", ""), "other"),
        words=given.get("description") or schema.get("description") or "",
        optional=len(wanted) < len(options),
        choices=choices,
        least=next((only[name] for name in _LEAST if name in only), None),
        most=next((only[name] for name in _MOST if name in only), None),
    )


def _resolved(schema: Mapping[str, Any], tables: Mapping[str, Any]) -> Mapping[str, Any]:
    reference: str = schema.get("$ref", "")
    return tables[reference.rpartition("/")[2]] if reference else schema
