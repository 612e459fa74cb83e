"""Browsers and programs that the robot knows, made without the detour over an invitation."""

from __future__ import annotations

from server.access import Access, Role, Scope


async def new_device(access: Access, role: Role = Role.OWNER) -> str:
    """A new person with one device; returns what stands in its cookie."""
    person = await access.register.add_person(role.value.title(), role, None)
    _, cookie = await access.register.add_device(person, "Test", "192.0.2.7")
    return cookie


async def new_key(access: Access, *scopes: Scope) -> str:
    """A new key, as a program sends it."""
    _, key = await access.register.add_key("test", scopes, "a test")
    return key
