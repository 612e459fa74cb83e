"""What a station driver must not forget when this process ends: old modes to be restored."""

from __future__ import annotations

import asyncio
import json
import os
from pathlib import Path

from drivers.station.errors import StationMemoryError


class StationMemory:
    """A small file of names and texts, replaced as a whole at every change.

    Args:
        path: The file; None keeps everything in this process only.
    """

    def __init__(self, path: Path | None = None) -> None:
        self._path = path
        self._texts: dict[str, str] | None = None
        self._one_at_a_time = asyncio.Lock()

    async def get(self, name: str) -> str | None:
        """The text of that name, if there is one.

        Raises:
            StationMemoryError: the file cannot be read.
        """
        async with self._one_at_a_time:
            return (await self._known()).get(name)

    async def put(self, name: str, text: str | None) -> None:
        """Remember a text, or forget it with None; on the disk when this returns.

        Raises:
            StationMemoryError: the file cannot be written; nothing has changed.
        """
        async with self._one_at_a_time:
            texts = dict(await self._known())
            if text is None:
                texts.pop(name, None)
            else:
                texts[name] = text
            if texts == self._texts:
                return
            if self._path is not None:
                await asyncio.to_thread(_write, self._path, texts)
            self._texts = texts

    async def _known(self) -> dict[str, str]:
        if self._texts is None:
            path = self._path
            self._texts = {} if path is None else await asyncio.to_thread(_read, path)
        return self._texts


def _read(path: Path) -> dict[str, str]:
    try:
        texts = json.loads(path.read_text("utf-8"))
    except FileNotFoundError:
        return {}
    except (OSError, ValueError) as error:
        raise StationMemoryError(
            f"{path} cannot be read ({error}). Look up the mode of the energy manager yourself, "
            "then delete the file."
        ) from error
    if not isinstance(texts, dict) or not all(isinstance(text, str) for text in texts.values()):
        raise StationMemoryError(
            f"{path} is not a file of this program. Look up the mode of the energy manager "
            "yourself, then delete the file."
        )
    return texts


def _write(path: Path, texts: dict[str, str]) -> None:
    beside = path.with_name(path.name + ".new")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with beside.open("w", encoding="utf-8") as file:
            json.dump(texts, file)
            file.flush()
            os.fsync(file.fileno())
        beside.replace(path)
    except OSError as error:
        raise StationMemoryError(
            f"{path} cannot be written ({error}). Make room on the disk and allow this program "
            "to write there."
        ) from error
