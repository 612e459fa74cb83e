"""The control channel of the simulator: what truly is, and what goes wrong."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Literal, Protocol

from tests.rig.truth import Statistics, Step, TrueState

CPU_HZ = 16_000_000

SwitchHealth = Literal["whole", "cut", "stuck"]


class ControlError(RuntimeError):
    """The simulator refused a command or has ended."""


class Channel(Protocol):
    """The way to a simulator."""

    async def say(self, line: str) -> dict[str, Any]:
        """Send a command and wait for its answer.

        Raises:
            ControlError: it was refused, or the simulator has ended.
        """
        ...

    def say_soon(self, line: str) -> None:
        """Send a command before all later ones; nobody waits for its answer."""
        ...

    def on_sample(self, listener: Callable[[TrueState], None]) -> None:
        """Call with every sample that the simulator takes by itself."""
        ...


class Control:
    """Everything that can be done to the simulated machine; see auriga/commands.hpp."""

    def __init__(self, channel: Channel) -> None:
        self._channel = channel

    def on_sample(self, listener: Callable[[TrueState], None]) -> None:
        """Call with every sample that the simulator takes by itself."""
        self._channel.on_sample(listener)

    # --- what is -----------------------------------------------------------------------------

    async def state(self) -> TrueState:
        """The truth now."""
        return await self._do("state")

    async def statistics(self) -> Statistics:
        """Since the start or ``forget``."""
        return Statistics.model_validate(await self.say("statistics"))

    async def forget(self) -> None:
        """Begin the statistics anew."""
        await self.say("forget")

    async def record_steps(self) -> None:
        """Note every step from now on."""
        await self.say("record on")

    async def recorded_steps(self) -> tuple[list[Step], list[Step]]:
        """Of rho1 and rho2, since ``record_steps``; ends the recording."""
        await self.say("record off")
        rails = (await self.say("steps"))["rails"]
        one, two = ([Step(c / CPU_HZ, tick, position) for c, tick, position in r] for r in rails)
        return one, two

    # --- what goes wrong; each returns the truth at that very moment -------------------------

    def load_soon(self, first_mm: float, spacing_mm: float, force_n: Sequence[float]) -> None:
        """Force against the screw over its position, held beyond the ends; waits for no answer."""
        forces = " ".join(f"{force:.3f}" for force in force_n)
        self._channel.say_soon(f"load {first_mm:.5f} {spacing_mm:.5f} {forces}")

    async def spoil_switch(self, axis: int, health: SwitchHealth) -> TrueState:
        """A limit switch, 0, 1, 2 for rho1, rho2, rho3: its wire cut, or stuck as released."""
        return await self._do(f"switch {axis} {health}")

    async def press_stop_button(self, *, pressed: bool = True) -> TrueState:
        """The emergency-stop button: opens the circuit and cuts the motors' power."""
        return await self._do(f"stop_button {'pressed' if pressed else 'released'}")

    async def jam(self, *, jammed: bool = True) -> TrueState:
        """Hold the slide where it is."""
        return await self._do(f"jam {'on' if jammed else 'off'}")

    async def kill_encoder(self, *, dead: bool = True) -> TrueState:
        """The encoder's lines stand still."""
        return await self._do(f"encoder {'dead' if dead else 'alive'}")

    async def reset(self, *, power: bool = False) -> TrueState:
        """Press the board's reset button, or take its power for a moment."""
        return await self._do(f"reset {'power' if power else 'button'}")

    async def hang(self) -> TrueState:
        """The firmware's main loop never comes round again."""
        return await self._do("hang")

    async def flip_eeprom(self, address: int, mask: int = 0xFF) -> TrueState:
        """Turn bits of a byte of the EEPROM."""
        return await self._do(f"eeprom {address} {mask}")

    async def cut_link(self, *, cut: bool = True) -> TrueState:
        """Both data wires; the host still sees its device."""
        return await self._do(f"link {'cut' if cut else 'whole'}")

    async def unplug(self) -> TrueState:
        """Pull the USB plug: the host's device vanishes."""
        return await self._do("link unplugged")

    async def plug_in(self) -> TrueState:
        """Put the USB plug back."""
        return await self._do("link plugged")

    async def spoil_link(
        self,
        *,
        lose: float = 0.0,
        flip: float = 0.0,
        duplicate: float = 0.0,
        delay_s: float = 0.0,
    ) -> TrueState:
        """Chances per byte that it is lost, gets a wrong bit, or comes twice; both ways."""
        return await self._do(f"faults {lose:g} {flip:g} {duplicate:g} {delay_s:g}")

    # --- the channel -------------------------------------------------------------------------

    async def say(self, line: str) -> dict[str, Any]:
        """Send a command and wait for its answer.

        Raises:
            ControlError: it was refused, or the simulator has ended.
        """
        return await self._channel.say(line)

    async def _do(self, line: str) -> TrueState:
        return TrueState.model_validate(await self.say(line))
