"""Takes secrets out of texts that leave the house."""

from __future__ import annotations

import re
from collections.abc import Iterator

from pydantic import BaseModel, SecretBytes, SecretStr

from server.access.tokens import KEY_PREFIX
from server.config.problems import HIDDEN

_LOGIN = re.compile(r"(//)[^/@\s\"]*@")
_INVITATION = re.compile(r"(#pair=)[\w-]+")
_KEY = re.compile(re.escape(KEY_PREFIX) + r"[\w-]{20,}")
_WEBHOOK_SECRET = re.compile(r"whsec_[A-Za-z0-9+/=_-]+")
_BEARER = re.compile(r"(?i)(bearer\s+)\S+")
_COOKIE = re.compile(r"(?i)((?:set-)?cookie:?\s*)[^\r\n\"]+")
SHORTEST = 4
"""A shorter secret would be found in half of all words."""


class Redaction:
    """Knows the secrets of a configuration, and what others look like.

    Args:
        settings: The whole configuration.
    """

    def __init__(self, settings: BaseModel) -> None:
        found = {secret for secret in _secrets(settings) if len(secret) >= SHORTEST}
        # The longest first: one may be a part of another.
        self._secrets = sorted(found, key=len, reverse=True)

    def clean(self, text: str) -> str:
        """The text without what opens anything."""
        for secret in self._secrets:
            text = text.replace(secret, HIDDEN)
        text = _LOGIN.sub(rf"\1{HIDDEN}@", text)
        text = _INVITATION.sub(rf"\1{HIDDEN}", text)
        text = _BEARER.sub(rf"\1{HIDDEN}", text)
        text = _COOKIE.sub(rf"\1{HIDDEN}", text)
        text = _WEBHOOK_SECRET.sub(HIDDEN, text)
        return _KEY.sub(HIDDEN, text)


def _secrets(value: object) -> Iterator[str]:
    match value:
        case SecretStr():
            yield value.get_secret_value()
        case SecretBytes():
            yield value.get_secret_value().decode(errors="replace")
        case BaseModel():
            for name in type(value).model_fields:
                yield from _secrets(getattr(value, name))
        case dict():
            for each in value.values():
                yield from _secrets(each)
        case list() | tuple():
            for each in value:
                yield from _secrets(each)
