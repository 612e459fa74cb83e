"""How far a routine is, and what it asks of a person."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass, field

from server.calibration.routines.errors import AnswerUnfitError, NoQuestionError
from server.schema.routines import RoutineAnswer, RoutineInput, RoutineLook, RoutineQuestion


@dataclass(slots=True)
class Progress:
    """Filled by a routine, shown by the desk.

    Attributes:
        changed: Called when there is something new.
        doing: In a sentence.
        done: Places that were looked from.
        total: Places to look from; 0 until they are chosen.
        looks: Where, and whether the label was there.
        asks: What it waits for.
    """

    changed: Callable[[], None]
    doing: str = "Making the robot ready."
    done: int = 0
    total: int = 0
    looks: list[RoutineLook] = field(default_factory=list)
    asks: RoutineQuestion | None = None
    _answer: asyncio.Future[float | None] | None = None

    def say(self, doing: str) -> None:
        """Show what is going on."""
        self.doing = doing
        self.changed()

    def restart(self) -> None:
        """Begin anew: what was looked from before counts no more."""
        self.done = self.total = 0
        self.looks.clear()
        self.changed()

    def looked(self, x_mm: float, y_mm: float, *, seen: bool) -> None:
        """A place is done."""
        self.looks.append(RoutineLook(x_mm=round(x_mm, 1), y_mm=round(y_mm, 1), seen=seen))
        self.done += 1
        self.changed()

    def step(self) -> None:
        """A step that looks at nothing is done."""
        self.done += 1
        self.changed()

    async def confirm(self, code: str, text: str) -> None:
        """Wait until a person has done something."""
        await self._ask(RoutineQuestion(code=code, text=text, input=None))

    async def number(self, code: str, text: str, asked: RoutineInput) -> float:
        """Wait until a person has typed in a number."""
        value = await self._ask(RoutineQuestion(code=code, text=text, input=asked))
        if value is None:
            raise AssertionError("a number was asked for, and an answer without one was taken")
        return value

    def offer(self, code: str, text: str) -> asyncio.Future[float | None]:
        """Ask without waiting: what is under way goes on until there is an answer, or for good."""
        self.asks = RoutineQuestion(code=code, text=text, input=None)
        self._answer = asyncio.get_running_loop().create_future()
        self.changed()
        return self._answer

    def withdraw(self) -> None:
        """Ask nothing any more."""
        self.asks = self._answer = None

    def take_answer(self, answer: RoutineAnswer) -> None:
        """Answer what the routine asks.

        Raises:
            NoQuestionError: it asks nothing, or something else.
            AnswerUnfitError: the number is missing, or cannot be right.
        """
        asks, waiting = self.asks, self._answer
        if asks is None or waiting is None or waiting.done():
            raise NoQuestionError("The calibration asks nothing now.")
        if answer.code != asks.code:
            raise NoQuestionError("The calibration asks something else by now.")
        self._require_fit(asks.input, answer.value)
        self.asks = None  # before it goes on: nobody answers twice
        waiting.set_result(answer.value)
        self.changed()

    async def _ask(self, question: RoutineQuestion) -> float | None:
        self.asks, self._answer = question, asyncio.get_running_loop().create_future()
        self.changed()
        try:
            return await self._answer
        finally:
            self.asks = self._answer = None
            self.changed()

    @staticmethod
    def _require_fit(asked: RoutineInput | None, value: float | None) -> None:
        if asked is None:
            return
        wanted = f"a number from {asked.least:g} to {asked.most:g} {asked.unit}"
        if value is None:
            raise AnswerUnfitError(f"The calibration asks for {wanted}.")
        if not asked.least <= value <= asked.most:
            raise AnswerUnfitError(f"{value:g} {asked.unit} cannot be right: it must be {wanted}.")
