"""The settings in force: those of the start, with what was changed since over them."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Mapping
from datetime import datetime
from typing import Any

from pydantic import JsonValue, ValidationError

from server.adjusting.errors import (
    FixedSettingError,
    ImpossibleSettingError,
    NoSuchVersionError,
)
from server.adjusting.rehearsal import FieldTrouble, Rehearsal, differences, field_troubles
from server.config.problems import describe
from server.config.settings import Settings
from server.storage.settings import ChangedSettingsStore, Changes, SettingsVersion

_log = logging.getLogger(__name__)

CHANGEABLE = ("charge_point", "logging", "webhooks")
"""Sections whose users look at the settings each time; no motion and no force depends on them."""

PROTECTING = {("webhooks", "allowed_networks")}
"""Protects the home from whoever may use the API, so it is not theirs to change."""


class RunningSettings:
    """Knows what holds now. Changes survive a restart and win over file and environment.

    Args:
        initial: What PlugPilot was started with.
        store: Keeps the changes.
        now: The date.
    """

    def __init__(
        self, initial: Settings, store: ChangedSettingsStore, now: Callable[[], datetime]
    ) -> None:
        self.current = initial
        self._now = now
        self._initial = initial
        self._store = store
        self._changes: Changes = {}
        self._listeners: list[Callable[[Settings], None]] = []
        self._one_at_a_time = asyncio.Lock()

    async def start(self) -> None:
        """Take over what was changed before the restart, if it still makes sense."""
        changes = await self._store.load()
        try:
            self.current = _with(self._initial, changes)
        except ValidationError:
            _log.warning("what was changed over the API does not fit any more, and is ignored")
            return
        self._changes = changes

    def listen(self, listener: Callable[[Settings], None]) -> None:
        """Call ``listener`` with the settings now and after every change."""
        self._listeners.append(listener)
        listener(self.current)

    async def change(
        self,
        patch: Mapping[str, Mapping[str, JsonValue]],
        check: Callable[[Settings], None] = lambda _: None,
        by: str = "",
    ) -> Settings:
        """Change some settings; null gives one its value of the start back (RFC 7396).

        Args:
            patch: Sections with their settings.
            check: May refuse the change after a look at the settings as they are.
            by: Who wants it.

        Raises:
            FixedSettingError: one cannot be changed while PlugPilot runs; nothing has changed.
            ImpossibleSettingError: they cannot be so; nothing has changed.
            StorageError: they cannot be kept; nothing has changed.
        """
        _refuse_fixed(patch)
        return await self._take(lambda: _merged(self._changes, patch), check, by)

    async def restore(
        self, number: int, check: Callable[[Settings], None], by: str = ""
    ) -> Settings:
        """Let everything hold again that held after an earlier change.

        Args:
            number: Of the version; 0 is what PlugPilot was started with.
            check: May refuse the change after a look at the settings as they are.
            by: Who wants it.

        Raises:
            NoSuchVersionError: it is not kept.
            ImpossibleSettingError: they cannot be so any more; nothing has changed.
            StorageError: they cannot be kept; nothing has changed.
        """
        changes: Changes = {}
        if number != 0:
            kept = [each for each in await self._store.versions() if each.number == number]
            if not kept:
                raise NoSuchVersionError(f"There is no version {number} of the settings.")
            changes = kept[0].changes
        return await self._take(lambda: changes, check, by)

    async def versions(self) -> list[SettingsVersion]:
        """What is kept of the past, the newest first."""
        return await self._store.versions()

    def rehearse(self, patch: Mapping[str, Mapping[str, JsonValue]]) -> Rehearsal:
        """What a change would do, or what is wrong with it; nothing changes."""
        try:
            _refuse_fixed(patch)
        except FixedSettingError as error:
            return Rehearsal(troubles=[FieldTrouble("", error.detail)])
        try:
            then = _with(self._initial, _merged(self._changes, patch))
        except ValidationError as error:
            return Rehearsal(troubles=field_troubles(error))
        return Rehearsal(differences=differences(self.current, then))

    async def _take(
        self, wanted: Callable[[], Changes], check: Callable[[Settings], None], by: str
    ) -> Settings:
        async with self._one_at_a_time:
            check(self.current)
            changes = wanted()
            try:
                settings = _with(self._initial, changes)
            except ValidationError as error:
                problems = [describe(problem, ()) for problem in error.errors()]
                raise ImpossibleSettingError("; ".join(problems) + ".", problems=problems) from None
            await self._store.save(changes, self._now(), by)
            self._changes, self.current = changes, settings
        for listener in self._listeners:
            listener(settings)
        return settings


def _refuse_fixed(patch: Mapping[str, Mapping[str, JsonValue]]) -> None:
    for section, wanted in patch.items():
        if section not in CHANGEABLE:
            raise FixedSettingError(
                f"Only settings in {', '.join(CHANGEABLE)} can be changed, not {section[:40]}.",
                changeable=list(CHANGEABLE),
            )
        for key in wanted:
            if (section, key) in PROTECTING:
                raise FixedSettingError(f"{section}.{key} is set in the configuration file only.")


def _merged(changes: Changes, patch: Mapping[str, Mapping[str, JsonValue]]) -> Changes:
    merged = {name: dict(section) for name, section in changes.items()}
    for name, wanted in patch.items():
        section = merged.setdefault(name, {})
        for key, value in wanted.items():
            if value is None:
                section.pop(key, None)
            else:
                section[key] = value
        if not section:
            del merged[name]
    return merged


def _with(initial: Settings, changes: Changes) -> Settings:
    values: dict[str, Any] = initial.model_dump()
    for name, section in changes.items():
        values[name] = {**values.get(name, {}), **section}
    return Settings(**values)
