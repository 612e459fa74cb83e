"""Measure the slide's friction from empty strokes and, against a known spring, its force scale."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from drivers.robot import RobotState
from server.calibration.axes.estimates import Estimate
from server.calibration.axes.following import FollowingWatch
from server.calibration.force.gauge import (
    Array,
    StrokeWatch,
    friction_and_offset,
    scale_by_spring,
)
from server.calibration.force.verdict import judge_force
from server.calibration.routines.errors import NoSpringError, SlideHitError
from server.calibration.routines.progress import Progress
from server.calibration.routines.stand import Stand
from server.calibration.versions.new_calibration import NewCalibration
from server.control.errors import ControlError
from server.schema.calibrations import ForceValues
from server.schema.routines import ForceRoutineRequest
from twin.motion import plan_joint_move

FREE_N = 20.0
"""More than a slide takes that moves freely."""
SPRING_TO_N, BOARD_ENDS_AT_N = 35.0, 45.0
SLOWLY = 0.5


class _ForceMetError(ControlError):
    """The slide pushes with the force that was waited for."""

    code = "calibration_force_met"
    title = "The slide has met a force"


@dataclass(slots=True, eq=False)
class ForceRoutine:
    """One run; after an interruption everything is measured anew.

    It measures what the board shows, whatever scale is in force.

    Attributes:
        request: What was asked for.
        by: Who asked.
        vehicle: None: it looks at nothing.
    """

    request: ForceRoutineRequest
    by: str
    vehicle: None = None
    _following: FollowingWatch = field(default_factory=FollowingWatch)

    async def run(self, stand: Stand, progress: Progress) -> NewCalibration:
        """Strokes in the air, then, if a spring is there, against it.

        Raises:
            SlideHitError: an empty stroke met something.
            NoSpringError: the other ones did not.
            ControlError: the robot gave up.
        """
        request = self.request
        progress.done, progress.total = 0, 2 * request.strokes
        if request.spring_n_mm is not None:
            progress.total *= 2
        progress.say("Making the robot ready.")
        await stand.make_ready()
        await progress.confirm(
            "force_clear",
            f"Let nothing stand within {request.stroke_mm:g} mm before the plug, then confirm.",
        )
        board_ends_at_n = stand.supervisor.built.true_n(BOARD_ENDS_AT_N)
        await stand.supervisor.set_force_limit(stand.lease, board_ends_at_n)
        out_n, back_n = await self._empty(stand, progress)
        friction, offset = friction_and_offset(out_n, back_n)
        scale = await self._against_spring(stand, progress, friction, offset)
        return self._found(stand, friction, offset, scale, (out_n, back_n))

    async def _empty(self, stand: Stand, progress: Progress) -> tuple[list[float], list[float]]:
        """Mean forces of the strokes out, and of those back [N]."""
        found: tuple[list[float], list[float]] = ([], [])
        for number in range(self.request.strokes):
            progress.say(f"Moving the slide freely, {number + 1} of {self.request.strokes}.")
            for way, out in zip(found, (True, False), strict=True):
                try:
                    stroke = await self._stroke(stand, FREE_N, out=out)
                except _ForceMetError as error:
                    await self._stroke(stand, BOARD_ENDS_AT_N, out=False)
                    raise SlideHitError(
                        f"On a stroke that should be free it took "
                        f"{abs(float(error.context['force_n'])):.0f} N.",
                        **error.context,
                    ) from error
                way.append(float(stroke.cruising[:, 1].mean()))
                progress.step()
        return found

    async def _against_spring(
        self, stand: Stand, progress: Progress, friction: Estimate, offset: Estimate
    ) -> Estimate | None:
        rate = self.request.spring_n_mm
        if rate is None:
            return None
        await progress.confirm(
            "force_spring",
            f"Put the spring of {rate:g} N/mm straight before the plug, against something firm, "
            "then confirm. The plug will push it together.",
        )
        strokes: list[Array] = []
        free_n: list[float] = []
        for number in range(self.request.strokes):
            progress.say(f"Pushing the spring, {number + 1} of {self.request.strokes}.")
            out = await self._until_met(stand)
            progress.step()
            back = await self._stroke(stand, BOARD_ENDS_AT_N, out=False)
            progress.step()
            strokes += [out.cruising, back.cruising]
            free_n += [offset.value + friction.value, offset.value - friction.value]
        try:
            return scale_by_spring(strokes, free_n, rate, self.request.spring_sigma)
        except ValueError as error:
            raise NoSpringError("The force did not rise as a spring's does.") from error

    async def _until_met(self, stand: Stand) -> StrokeWatch:
        watch = self._watch(SPRING_TO_N)
        travel = stand.supervisor.geometry.rho3
        try:
            await self._move(stand, travel.max_mm, watch)
        except _ForceMetError:
            return watch
        await self._stroke(stand, BOARD_ENDS_AT_N, out=False)
        raise NoSpringError(f"All the way out the slide met less than {SPRING_TO_N:.0f} N.")

    async def _stroke(self, stand: Stand, end_at_n: float, *, out: bool) -> StrokeWatch:
        watch = self._watch(end_at_n)
        start_mm = stand.supervisor.geometry.rho3.min_mm
        await self._move(stand, start_mm + (self.request.stroke_mm if out else 0.0), watch)
        return watch

    async def _move(self, stand: Stand, rho3_mm: float, watch: StrokeWatch) -> None:
        supervisor = stand.supervisor
        here = supervisor.telemetry.require().commanded.position
        plan = plan_joint_move(
            supervisor.limits.scaled(SLOWLY), here, here._replace(rho3_mm=rho3_mm)
        )
        built = supervisor.built

        def as_shown(state: RobotState) -> None:
            watch.take(replace(state, force_n=built.shown_n(state.force_n)))

        await supervisor.follow(stand.lease, plan, as_shown)

    def _watch(self, end_at_n: float) -> StrokeWatch:
        return StrokeWatch(end_at_n, _ForceMetError, self._following)

    def _found(
        self,
        stand: Stand,
        friction: Estimate,
        offset: Estimate,
        scale: Estimate | None,
        strokes_n: tuple[list[float], list[float]],
    ) -> NewCalibration:
        grade, remarks = judge_force(friction, offset, scale)
        known = stand.in_force.force
        in_use = (known.friction_n, known.offset_n) if known else (0.0, 0.0)
        return NewCalibration(
            values=ForceValues(
                friction_n=friction.value,
                friction_sigma_n=friction.sigma,
                offset_n=offset.value,
                offset_sigma_n=offset.sigma,
                scale=scale.value if scale else (known.scale if known else 1.0),
                scale_sigma=scale.sigma if scale else (known.scale_sigma if known else None),
                following_mm=self._following.largest_mm[2],
            ),
            made_by=self.by,
            source=f"{self.request.strokes} strokes of {self.request.stroke_mm:g} mm"
            + (f", a spring of {self.request.spring_n_mm:g} N/mm" if scale else ""),
            grade=grade,
            remarks=remarks,
            error=_misses_n(strokes_n, friction.value, offset.value),
            error_in_use=_misses_n(strokes_n, *in_use),
        )


def _misses_n(
    strokes_n: tuple[list[float], list[float]], friction_n: float, offset_n: float
) -> float:
    """Root mean square of what each stroke is beside these figures [N]."""
    out, back = (np.asarray(one) for one in strokes_n)
    off = np.concatenate((out - offset_n - friction_n, back - offset_n + friction_n))
    return float(np.sqrt(np.mean(off**2)))
