"""Say in one line what is wrong with a setting: its key, its value, its origin, what may be."""

from __future__ import annotations

import difflib
import json
import re
from collections.abc import Iterator, Sequence
from typing import Any, get_args

from pydantic import BaseModel, SecretStr
from pydantic_core import ErrorDetails

from server.config.layers import Entry, Key
from server.config.settings import Settings

HIDDEN = "(hidden)"
_LOGIN_IN_ADDRESS = re.compile(r"(//)[^/@\s]*@")


def describe(problem: ErrorDetails, entries: Sequence[Entry]) -> str:
    """Word one problem that pydantic found."""
    key = tuple(str(part) for part in problem["loc"])
    dotted = ".".join(key)
    origin = _origin(key, entries)
    if problem["type"] == "extra_forbidden":
        return f"{dotted}{origin}: unknown key{_suggestion(key)}"
    given = problem["input"]
    if isinstance(given, dict) or not key:
        # the parts of a table do not fit together: the sentence of the check names them
        return f"{dotted or 'settings'}{origin}: {_wording(problem)}"
    shown = HIDDEN if is_secret(key) else _as_toml(given)
    return f"{dotted} = {shown}{origin}: {_wording(problem)}"


def is_secret(key: Key, model: type[BaseModel] = Settings) -> bool:
    """Whether the values of a setting, or of something inside it, must not be shown."""
    tables: list[type[BaseModel]] = [model]
    for name in key:
        annotations = [
            table.model_fields[name].annotation for table in tables if name in table.model_fields
        ]
        types = [part for annotation in annotations for part in _parts(annotation)]
        if SecretStr in types:
            return True
        tables = [part for part in types if isinstance(part, type) and issubclass(part, BaseModel)]
    return False


def _parts(annotation: object) -> Iterator[object]:
    """A type and everything that it is made of: `SecretStr | None` has two parts."""
    yield annotation
    for part in get_args(annotation):
        yield from _parts(part)


def known_keys(model: type[BaseModel] = Settings, above: Key = ()) -> Iterator[Key]:
    """The paths of all tables and values, outermost first."""
    for name, field in model.model_fields.items():
        key = (*above, name)
        yield key
        if isinstance(field.annotation, type) and issubclass(field.annotation, BaseModel):
            yield from known_keys(field.annotation, key)


def _origin(key: Key, entries: Sequence[Entry]) -> str:
    """Where the value, or the parts of the table, were set last."""
    origins = [entry.origin for entry in entries if entry.key[: len(key)] == key]
    exact = [entry.origin for entry in entries if entry.key == key]
    named = list(dict.fromkeys(exact[-1:] or origins))
    return f" in {', '.join(named)}" if named else ""


def _suggestion(key: Key) -> str:
    keys = list(known_keys())
    siblings = {known[-1]: known for known in keys if known[:-1] == key[:-1]}
    anywhere = {known[-1]: known for known in keys}
    for candidates in (siblings, anywhere):
        near = difflib.get_close_matches(key[-1], candidates, n=1)
        if near:
            return f"; did you mean {'.'.join(candidates[near[0]])}?"
    return f"; known here: {', '.join(sorted(siblings))}" if siblings else ""


def _wording(problem: ErrorDetails) -> str:
    if problem["type"] in {"model_type", "model_attributes_type", "dict_type"}:
        return "must be a table"
    if problem["type"] == "missing":
        return "is missing"
    message = problem["msg"].removeprefix("Value error, ")
    return message.replace("Input should", "must", 1)


def _as_toml(value: Any) -> str:  # noqa: ANN401 - anything a file or a person can give
    if isinstance(value, list | tuple) and any(isinstance(part, dict) for part in value):
        return "a list of tables"  # which may hold a secret
    text = json.dumps(value, default=str, ensure_ascii=False)
    return _LOGIN_IN_ADDRESS.sub(rf"\1{HIDDEN}@", text)
