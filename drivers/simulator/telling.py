"""Puts what goes to and from the simulated board into words, as a real link's frames are."""

from __future__ import annotations

from collections.abc import Sequence

from drivers.robot import RobotDriverError, RobotState
from drivers.robot.traffic import Passage
from twin.motion.segments import Segment


def command_passage(kind: str, words: str, at_s: float) -> Passage:
    """A command on its way to the board."""
    return Passage(at_s, to_board=True, kind=kind, words=words, error=kind == "EmergencyStop")


def refusal_passage(kind: str, refusal: RobotDriverError, at_s: float) -> Passage:
    """The board's refusal of a command."""
    return Passage(at_s, to_board=False, kind="Refused", words=f"{kind}: {refusal}", error=True)


def sample_passage(sample: RobotState, before: RobotState | None, at_s: float) -> Passage:
    """A sample of telemetry; one that tells of a new fault is an error."""
    joints = " ".join(
        f"rho{number}={measured:.3f}/{commanded:.3f}"
        for number, (measured, commanded) in enumerate(
            zip(sample.measured.position, sample.commanded.position, strict=True), start=1
        )
    )
    fault = sample.fault
    words = (
        f"state={sample.board.name} {joints} force_n={sample.force_n:.1f} "
        f"enabled={int(sample.enabled)} homed={int(sample.homed)} queue_free={sample.queue_free}"
    )
    if fault is not None:
        words += f" fault={fault.code.name}: {fault.detail}"
    new_fault = fault is not None and (before is None or before.fault != fault)
    return Passage(at_s, to_board=False, kind="Telemetry", words=words, error=new_fault)


def segments_words(segments: Sequence[Segment]) -> str:
    """Several segments in one line."""
    if not segments:
        return "none"
    end = " ".join(f"rho{number}={mm:.3f}" for number, mm in enumerate(segments[-1].end, start=1))
    lasts_s = sum(segment.duration_s for segment in segments)
    return f"{len(segments)} segments, {1000 * lasts_s:.0f} ms, to {end}"
