"""The camera's own numbers, from pictures of a board that somebody holds before it.

The robot stands still and looks. Whenever the board is found, still, sharp, and held as it has not
been before, the picture counts; what would tell most next is shown to whoever holds the board. It
ends by itself when nothing is missing, or when somebody says that there are enough.
"""

from __future__ import annotations

import asyncio
from dataclasses import dataclass, field

from drivers.camera import Frame
from server.calibration.camera.board_sight import BoardFinder, BoardSight
from server.calibration.camera.board_views import BoardViews
from server.calibration.camera.collecting import BoardCollection
from server.calibration.camera.coverage import coverage_map
from server.calibration.camera.errors import NoBoardError, WrongBoardError
from server.calibration.camera.in_use import camera_error_px
from server.calibration.camera.solve import CameraSolution, solve_camera
from server.calibration.camera.verdict import judge
from server.calibration.routines.errors import BoardBlurredError, TooFewViewsError
from server.calibration.routines.progress import Progress
from server.calibration.routines.stand import Stand
from server.calibration.versions.new_calibration import NewCalibration
from server.jpeg import as_jpeg
from server.labels.board_layout import BoardLayout
from server.schema.board import BoardLook, BoardNotice
from server.schema.calibrations import CameraEvidence, CameraValues, CameraViewRecord
from server.schema.routines import CameraRoutineRequest

PERIOD_S = 0.15
"""From one look to the next at least; a hand that holds still does so for longer."""
FEWEST_VIEWS = 10
WIDTH_PX, QUALITY = 820, 75
UNSEEN_S, OTHER_S, BLURRED_S, IDLE_S = 90.0, 6.0, 25.0, 180.0
"""So long it waits for the board, for the right one, for a sharp picture, for a new view."""


@dataclass(slots=True, eq=False)
class CameraRoutine:
    """One run; after an interruption it goes on with the views that it has.

    Attributes:
        request: What was asked for.
        by: Who asked.
        vehicle: None: it looks at a board.
    """

    request: CameraRoutineRequest
    by: str
    vehicle: None = None
    _kept: BoardCollection | None = None
    _since_s: dict[str, float] = field(default_factory=dict)

    async def run(self, stand: Stand, progress: Progress) -> NewCalibration:
        """Collect views, and solve for the camera.

        Raises:
            NoBoardError, WrongBoardError, BoardBlurredError, TooFewViewsError: it does not get on.
            CalibrationDivergedError: no camera explains the views.
            CameraDownError: the camera does not deliver.
        """
        optics = stand.eye.optics
        if self._kept is None:
            self._kept = BoardCollection(optics.width, optics.height)
        kept = self._kept
        await self._collect(stand, progress, kept)
        await stand.board.close()
        progress.say("Working out the camera from the pictures.")
        return await asyncio.to_thread(self._found, stand, kept)

    async def _collect(self, stand: Stand, progress: Progress, kept: BoardCollection) -> None:
        loop = asyncio.get_running_loop()
        speed = stand.settings.clock_speed
        finder = BoardFinder(self._layout, stand.eye.optics)
        self._since_s = dict.fromkeys(("seen", "right", "sharp", "new"), loop.time())
        progress.done, progress.total = len(kept.views), kept.wanted
        progress.say("Watching for the board.")
        enough = None
        while not kept.complete and (enough is None or not enough.done()):
            due_s = loop.time() + PERIOD_S * speed
            frame = await stand.eye.frame()
            sequence = stand.board.next_sequence
            sight, jpeg = await asyncio.to_thread(_work, finder, frame, f"picture {sequence}")
            notice = kept.take(sight, frame.captured_at_s)
            await stand.board.show(_look(kept, frame, sequence, sight, notice), jpeg)
            if notice == "taken":
                progress.total = kept.wanted
                progress.step()
            if enough is None and len(kept.views) >= FEWEST_VIEWS:
                enough = progress.offer(
                    "camera_enough", "End when you like: what there is can be worked out now."
                )
            if self._out_of_patience(notice, kept, loop.time(), speed):
                break
            await asyncio.sleep(max(due_s - loop.time(), 0.0))
        progress.withdraw()

    def _out_of_patience(
        self, notice: BoardNotice, kept: BoardCollection, now_s: float, speed: float
    ) -> bool:
        """Nothing new has come for long, but there are enough views.

        Raises:
            NoBoardError, WrongBoardError, BoardBlurredError, TooFewViewsError: there are not.
        """
        since_s = self._since_s
        if notice != "no_board":
            since_s["seen"] = now_s
        if notice != "other_board":
            since_s["right"] = now_s
        if notice != "blurred":
            since_s["sharp"] = now_s
        if notice == "taken":
            since_s["new"] = now_s
        waited_s = {name: (now_s - then_s) / speed for name, then_s in since_s.items()}
        if waited_s["right"] > OTHER_S:
            layout = self._layout
            raise WrongBoardError(
                f"There are markers, but not those of a board of {layout.columns} x {layout.rows} "
                "squares."
            )
        if waited_s["sharp"] > BLURRED_S:
            raise BoardBlurredError(
                f"For {BLURRED_S:.0f} s the board has stood still, and was blurred all the same."
            )
        if max(waited_s["seen"] - UNSEEN_S, waited_s["new"] - IDLE_S) < 0:
            return False
        if len(kept.views) >= FEWEST_VIEWS:
            return True
        if waited_s["seen"] > UNSEEN_S:
            raise NoBoardError(f"For {UNSEEN_S:.0f} s no board was to be seen.")
        raise TooFewViewsError(
            f"There are {len(kept.views)} different views of the board, and {FEWEST_VIEWS} are "
            "needed."
        )

    @property
    def _layout(self) -> BoardLayout:
        drawn, square_mm = BoardLayout(), self.request.square_mm
        scale = square_mm / drawn.square_mm
        return BoardLayout(square_mm=square_mm, marker_mm=scale * drawn.marker_mm)

    def _found(self, stand: Stand, kept: BoardCollection) -> NewCalibration:
        views = BoardViews(tuple(kept.views), (), kept.width_px, kept.height_px)
        solution = solve_camera(views)
        used = {view.name for view in solution.views if view.used}
        coverage = coverage_map(
            [view for view in views.views if view.name in used], kept.width_px, kept.height_px
        )
        verdict = judge(solution, coverage)
        return NewCalibration(
            values=CameraValues(camera=solution.camera),
            made_by=self.by,
            source=f"{len(used)} pictures of the board, squares of {self.request.square_mm:g} mm",
            grade=verdict.grade,
            remarks=verdict.remarks,
            error=solution.check_px,
            error_in_use=camera_error_px(stand.eye.optics, kept.views),
            evidence=_evidence(solution, coverage.tolist()),
        )


def _work(finder: BoardFinder, frame: Frame, name: str) -> tuple[BoardSight, bytes]:
    return finder.find(frame.image, name), as_jpeg(
        frame.image, quality=QUALITY, most_width_px=WIDTH_PX
    )


def _look(
    kept: BoardCollection, frame: Frame, sequence: int, sight: BoardSight, notice: BoardNotice
) -> BoardLook:
    height, width = frame.image.shape
    corners = sight.view.image_px.round(1).tolist() if sight.view else []
    return BoardLook(
        sequence=sequence,
        width_px=width,
        height_px=height,
        corners_px=[(x, y) for x, y in corners],
        outline_px=sight.outline_px,
        notice=notice,
        wish=kept.wish,
        taken=len(kept.views),
        wanted=kept.wanted,
        coverage=kept.coverage.tolist(),
    )


def _evidence(solution: CameraSolution, coverage: list[list[int]]) -> CameraEvidence:
    return CameraEvidence(
        views=[
            CameraViewRecord(
                rms_px=view.rms_px,
                tilt_rad=view.tilt_rad,
                distance_mm=view.distance_mm,
                used=view.used,
            )
            for view in solution.views
        ],
        coverage=coverage,
        sigma=solution.sigma,
        rms_px=solution.rms_px,
        check_px=solution.check_px,
    )
