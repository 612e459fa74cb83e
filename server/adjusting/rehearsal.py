"""What a change of settings would do, told field by field before it is made."""

from __future__ import annotations

from dataclasses import dataclass, field

from pydantic import JsonValue, ValidationError

from server.config.layers import leaves
from server.config.problems import HIDDEN, describe, is_secret
from server.config.settings import Settings


@dataclass(frozen=True, slots=True)
class FieldTrouble:
    """What is wrong, and where.

    Attributes:
        key: Dotted, such as webhooks.timeout_s; empty if it is about no one field.
        sentence: For a person.
    """

    key: str
    sentence: str


@dataclass(frozen=True, slots=True)
class Difference:
    """One setting that would be another; secrets are hidden."""

    key: str
    before: JsonValue
    after: JsonValue


@dataclass(frozen=True, slots=True)
class Rehearsal:
    """Either troubles or differences; neither if nothing would change."""

    troubles: list[FieldTrouble] = field(default_factory=list)
    differences: list[Difference] = field(default_factory=list)


def field_troubles(error: ValidationError) -> list[FieldTrouble]:
    """Each problem with the field that it is about."""
    return [
        FieldTrouble(_field(problem["loc"]), describe(problem, ()) + ".")
        for problem in error.errors()
    ]


def differences(now: Settings, then: Settings) -> list[Difference]:
    """Every setting that is not the same, in the order of the configuration."""
    before = dict(leaves(now.model_dump(mode="json")))
    after = dict(leaves(then.model_dump(mode="json")))
    keys = [*before, *(key for key in after if key not in before)]
    return [
        Difference(
            ".".join(key),
            HIDDEN if is_secret(key) else before.get(key),
            HIDDEN if is_secret(key) else after.get(key),
        )
        for key in keys
        if before.get(key) != after.get(key)
    ]


def _field(place: tuple[int | str, ...]) -> str:
    """Section and setting; what lies deeper in a list belongs to the same field."""
    return ".".join(str(part) for part in place[:2])
