from __future__ import annotations

import asyncio
import itertools
import json
from collections.abc import Awaitable, Callable
from typing import Any

import pytest
from pydantic import BaseModel

from server.live.hub import LiveHub
from server.schema.live import PROTOCOL_VERSION
from tests.support.virtual import run_virtual


class Value(BaseModel):
    number: int


class Section:
    """A section whose value is counted every time it is made."""

    def __init__(self, hub: LiveHub, name: str) -> None:
        self.value: int | None = 0
        self.built = 0
        hub.add(name, self.build)

    def build(self) -> Value | None:
        self.built += 1
        return None if self.value is None else Value(number=self.value)


class Watcher:
    """Reads as fast as messages come, unless it is told to be slow."""

    def __init__(self, hub: LiveHub, pause_s: float = 0.0) -> None:
        self.messages: list[tuple[float, dict[str, Any]]] = []
        self._hub = hub
        self._pause_s = pause_s
        self.task = asyncio.create_task(self._run())

    async def _run(self) -> None:
        async for message in self._hub.watch():
            self.messages.append((asyncio.get_running_loop().time(), json.loads(message)))
            if self._pause_s:
                await asyncio.sleep(self._pause_s)

    @property
    def numbers(self) -> list[int]:
        """Of the section "a" in all deltas."""
        return [
            m["changes"]["a"]["number"]
            for _, m in self.messages
            if m["type"] == "delta" and "a" in m["changes"]
        ]

    async def leave(self) -> None:
        self.task.cancel()
        await asyncio.wait([self.task])


def on_hub(scenario: Callable[[LiveHub, Section, Section], Awaitable[None]]) -> None:
    async def main() -> None:
        hub = LiveHub(0.05)
        a, b = Section(hub, "a"), Section(hub, "b")
        await asyncio.sleep(1.0)
        await scenario(hub, a, b)
        for task in asyncio.all_tasks() - {asyncio.current_task()}:
            task.cancel()

    run_virtual(main())


def test_a_watcher_gets_everything_first_and_then_only_changes() -> None:
    async def scenario(hub: LiveHub, a: Section, b: Section) -> None:
        b.value = None
        watcher = Watcher(hub)
        await asyncio.sleep(0.2)
        a.value = 1
        hub.changed("a")
        await asyncio.sleep(0.2)
        a.value, b.value = 2, 5
        hub.changed("a")
        hub.changed("b")
        await asyncio.sleep(0.2)
        first, second, third = (message for _, message in watcher.messages)
        assert first["type"] == "snapshot"
        assert first["version"] == PROTOCOL_VERSION
        assert first["live"] == {"a": {"number": 0}, "b": None}
        assert second.pop("sent_s") - first["sent_s"] == pytest.approx(0.2)
        assert second == {"type": "delta", "sequence": 2, "changes": {"a": {"number": 1}}}
        assert third["sequence"] == 3
        assert third["changes"] == {"a": {"number": 2}, "b": {"number": 5}}

    on_hub(scenario)


def test_what_has_not_really_changed_is_not_sent() -> None:
    async def scenario(hub: LiveHub, _a: Section, _b: Section) -> None:
        watcher = Watcher(hub)
        await asyncio.sleep(0.1)
        hub.changed("a")
        hub.changed("b", urgent=True)
        await asyncio.sleep(1.0)
        assert len(watcher.messages) == 1

    on_hub(scenario)


def test_a_slow_watcher_gets_the_newest_value_only_and_slows_nobody() -> None:
    async def scenario(hub: LiveHub, a: Section, _b: Section) -> None:
        slow, quick = Watcher(hub, pause_s=1.0), Watcher(hub)
        await asyncio.sleep(0.1)
        for number in range(1, 101):
            a.value = number
            hub.changed("a")
            await asyncio.sleep(0.05)
        await asyncio.sleep(2.0)
        assert quick.numbers == list(range(1, 101))
        assert len(slow.numbers) <= 7
        assert slow.numbers[-1] == 100
        assert [m["sequence"] for _, m in slow.messages] == list(range(1, len(slow.messages) + 1))

    on_hub(scenario)


def test_a_value_is_serialised_once_for_all_watchers() -> None:
    async def scenario(hub: LiveHub, a: Section, b: Section) -> None:
        watchers = [Watcher(hub) for _ in range(10)]
        await asyncio.sleep(0.1)
        built = a.built
        assert built == 1, "one snapshot serves all who come"
        a.value = 1
        hub.changed("a")
        await asyncio.sleep(0.2)
        assert a.built == built + 1
        assert b.built == 1, "what did not change is not built"
        assert all(watcher.numbers == [1] for watcher in watchers)

    on_hub(scenario)


def test_urgent_changes_go_at_once_and_others_twenty_times_a_second() -> None:
    async def scenario(hub: LiveHub, a: Section, b: Section) -> None:
        watcher = Watcher(hub)
        await asyncio.sleep(0.5)
        began_s = asyncio.get_running_loop().time()
        for number in range(1, 201):
            a.value = number
            hub.changed("a")
            await asyncio.sleep(0.005)
        ordinary = watcher.messages[1:]
        gaps = [y - x for (x, _), (y, _) in itertools.pairwise(ordinary)]
        assert 19 <= len(ordinary) <= 21
        assert min(gaps) >= 0.05 - 1e-9
        assert ordinary[0][0] == pytest.approx(began_s), "the first after a pause need not wait"
        a.value, b.value = -1, -1
        hub.changed("a")
        hub.changed("b", urgent=True)
        await asyncio.sleep(0)
        await asyncio.sleep(0)
        at_s, message = watcher.messages[-1]
        assert at_s == asyncio.get_running_loop().time()
        assert message["changes"] == {"a": {"number": -1}, "b": {"number": -1}}
        sent = len(watcher.messages)
        await asyncio.sleep(1.0)
        assert len(watcher.messages) == sent, "nothing comes twice"

    on_hub(scenario)


def test_without_watchers_nothing_is_built_and_no_timer_runs() -> None:
    async def scenario(hub: LiveHub, a: Section, _b: Section) -> None:
        for number in range(100):
            a.value = number
            hub.changed("a", urgent=number % 2 == 0)
        await asyncio.sleep(1.0)
        assert a.built == 0
        watcher = Watcher(hub)
        await asyncio.sleep(0.1)
        assert hub.watchers == 1
        assert watcher.messages[0][1]["live"]["a"] == {"number": 99}
        hub.changed("a")
        await watcher.leave()
        assert hub.watchers == 0
        built = a.built
        hub.changed("a", urgent=True)
        await asyncio.sleep(1.0)
        assert a.built == built

    on_hub(scenario)


def test_a_newcomer_takes_no_change_away_from_those_who_watch_already() -> None:
    async def scenario(hub: LiveHub, a: Section, _b: Section) -> None:
        first = Watcher(hub)
        await asyncio.sleep(0.5)
        a.value = 1
        hub.changed("a")
        await asyncio.sleep(0.01)
        a.value = 2
        hub.changed("a")  # waits for its turn, when somebody else comes
        second = Watcher(hub)
        await asyncio.sleep(0.5)
        assert first.numbers[-1] == 2
        assert second.messages[0][1]["live"]["a"] == {"number": 2}

    on_hub(scenario)
