"""Passkeys (WebAuthn): a person's own way back in, on any device that carries the passkey.

A passkey works only for the name it was made under, and only where the page has a secure origin:
https, or localhost. So it is an extra beside invitations, never the only way.
"""

from __future__ import annotations

import json
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from typing import Any

from webauthn import (
    base64url_to_bytes,
    generate_authentication_options,
    generate_registration_options,
    options_to_json,
    verify_authentication_response,
    verify_registration_response,
)
from webauthn.helpers import bytes_to_base64url, parse_client_data_json
from webauthn.helpers.exceptions import WebAuthnException
from webauthn.helpers.structs import (
    AuthenticatorSelectionCriteria,
    PublicKeyCredentialDescriptor,
    ResidentKeyRequirement,
    UserVerificationRequirement,
)

from server.access.audit import AuditLog
from server.access.errors import NoSuchEntryError, PasskeyError
from server.access.model import Device, Origin, Passkey, Person
from server.access.pairing import device_name
from server.access.register import Register, new_id
from server.access.rights import NO_RIGHTS

RP_NAME = "PlugPilot"
VALID = timedelta(minutes=5)
MAX_OPEN = 256
"""Challenges that are open at a time; with more the oldest is forgotten."""


@dataclass(frozen=True, slots=True)
class _Challenge:
    host: str
    person_id: str | None
    expires_at: datetime


class Passkeys:
    """Makes passkeys and recognises people by them.

    Args:
        register: Everybody who is known.
        audit: Is told of everything.
        now: The date.
    """

    def __init__(self, register: Register, audit: AuditLog, now: Callable[[], datetime]) -> None:
        self._register = register
        self._audit = audit
        self._now = now
        self._open: OrderedDict[bytes, _Challenge] = OrderedDict()

    def begin(self, person: Person, origin: Origin) -> dict[str, Any]:
        """Options for the browser that is to make a passkey of a person."""
        known = [p for p in self._register.passkeys.values() if p.person_id == person.id]
        options = generate_registration_options(
            rp_id=origin.host,
            rp_name=RP_NAME,
            user_id=person.id.encode(),
            user_name=person.name,
            user_display_name=person.name,
            authenticator_selection=AuthenticatorSelectionCriteria(
                resident_key=ResidentKeyRequirement.REQUIRED,
                user_verification=UserVerificationRequirement.REQUIRED,
            ),
            exclude_credentials=[PublicKeyCredentialDescriptor(p.credential_id) for p in known],
        )
        self._remember(options.challenge, origin, person.id)
        return _plain(options_to_json(options))

    async def add(
        self,
        person: Person,
        credential: dict[str, Any],
        origin: Origin,
        user_agent: str,
        address: str,
    ) -> Passkey:
        """Keep the passkey that the browser made.

        Raises:
            PasskeyError: it does not answer an open challenge of this person.
        """
        try:
            verified = verify_registration_response(
                credential=credential,
                expected_challenge=self._take(credential, origin, person.id),
                expected_rp_id=origin.host,
                expected_origin=origin.url,
                require_user_verification=True,
            )
        except WebAuthnException as error:
            raise self._refusal(f"person: {person.name}", address, error) from error
        passkey = Passkey(
            id=new_id(),
            person_id=person.id,
            name=device_name(user_agent),
            credential_id=verified.credential_id,
            public_key=verified.credential_public_key,
            sign_count=verified.sign_count,
            created_at=self._now(),
        )
        await self._register.put_passkey(passkey)
        self._audit.record(
            "passkey.added", actor=f"person: {person.name}", address=address, passkey=passkey.id
        )
        return passkey

    async def remove(self, person: Person, passkey_id: str, address: str) -> None:
        """Forget a passkey of a person.

        Raises:
            NoSuchEntryError: the person has no such passkey.
        """
        passkey = self._register.passkeys.get(passkey_id)
        if passkey is None or passkey.person_id != person.id:
            raise NoSuchEntryError(f"There is no passkey {passkey_id[:64]}.")
        await self._register.remove_passkey(passkey_id)
        self._audit.record(
            "passkey.removed", actor=f"person: {person.name}", address=address, passkey=passkey_id
        )

    def begin_login(self, origin: Origin) -> dict[str, Any]:
        """Options for a browser that wants to show a passkey. They tell nothing of anybody."""
        options = generate_authentication_options(
            rp_id=origin.host, user_verification=UserVerificationRequirement.REQUIRED
        )
        self._remember(options.challenge, origin, None)
        return _plain(options_to_json(options))

    async def log_in(
        self, credential: dict[str, Any], origin: Origin, user_agent: str, address: str
    ) -> tuple[Person, Device, str]:
        """Make a browser the device of whoever has the passkey.

        Raises:
            PasskeyError: not valid; the same for every reason.
        """
        try:
            challenge = self._take(credential, origin, None)
            passkey = self._named_by(credential)
            verified = verify_authentication_response(
                credential=credential,
                expected_challenge=challenge,
                expected_rp_id=origin.host,
                expected_origin=origin.url,
                credential_public_key=passkey.public_key,
                credential_current_sign_count=passkey.sign_count,
                require_user_verification=True,
            )
        except WebAuthnException as error:
            raise self._refusal("unknown", address, error) from error
        now = self._now()
        person = self._register.person(passkey.person_id)
        if person.rights(now) == NO_RIGHTS:
            raise self._refusal(f"person: {person.name}", address, "the rights have ended")
        await self._register.put_passkey(
            replace(passkey, sign_count=verified.new_sign_count, last_used_at=now)
        )
        device, cookie = await self._register.add_device(person, device_name(user_agent), address)
        self._audit.record(
            "login.done",
            actor=f"person: {person.name}",
            address=address,
            passkey=passkey.id,
            device=device.name,
            device_id=device.id,
        )
        return person, device, cookie

    def _named_by(self, credential: dict[str, Any]) -> Passkey:
        wanted = str(credential.get("id", ""))
        for passkey in self._register.passkeys.values():
            if bytes_to_base64url(passkey.credential_id) == wanted:
                return passkey
        raise WebAuthnException("no passkey has this id")

    def _remember(self, challenge: bytes, origin: Origin, person_id: str | None) -> None:
        self._open[challenge] = _Challenge(origin.host, person_id, self._now() + VALID)
        if len(self._open) > MAX_OPEN:
            self._open.popitem(last=False)

    def _take(self, credential: dict[str, Any], origin: Origin, person_id: str | None) -> bytes:
        """The open challenge that the browser answers: each is good for one answer."""
        response = credential.get("response")
        text = response.get("clientDataJSON", "") if isinstance(response, dict) else ""
        try:
            challenge = parse_client_data_json(base64url_to_bytes(text)).challenge
        except (ValueError, TypeError, KeyError) as error:
            raise WebAuthnException("the client data cannot be read") from error
        found = self._open.pop(challenge, None)
        if found is None or self._now() >= found.expires_at:
            raise WebAuthnException("no such challenge is open")
        if (found.host, found.person_id) != (origin.host, person_id):
            raise WebAuthnException("the challenge belongs to somebody else")
        return challenge

    def _refusal(self, actor: str, address: str, reason: object) -> PasskeyError:
        self._audit.record_burst(
            "passkey.refused", actor=actor, address=address, reason=str(reason)[:200]
        )
        return PasskeyError("It is not known here, or its answer did not fit.")


def _plain(options: str) -> dict[str, Any]:
    content: dict[str, Any] = json.loads(options)
    return content
