"""What the driver reads and hears: short, plain, in centimetres."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from server.guidance.model import Direction, PauseReason, Step, Unseen


class Manner(StrEnum):
    """How a car is on its way."""

    ROLLS = "rolls"
    TOO_FAST = "too_fast"
    ASKEW = "askew"
    STANDS = "stands"


class Outcome(StrEnum):
    """What there is to say about a car that is, or was, in view."""

    GOOD = "good"
    GOOD_FLAWED = "good_flawed"
    STOP = "stop"
    THIN = "thin"
    HIDDEN = "hidden"
    LEFT_AT_LEFT = "left_at_left"
    LEFT_AT_RIGHT = "left_at_right"
    LEFT_AT_TOP = "left_at_top"
    LEFT_AT_BOTTOM = "left_at_bottom"
    TOO_LOW = "too_low"
    TOO_HIGH = "too_high"
    SKEWED = "skewed"
    SKEWED_LEFT = "skewed_left"
    SKEWED_RIGHT = "skewed_right"


Reason = PauseReason | Unseen | Manner | Outcome


@dataclass(frozen=True, slots=True)
class Words:
    """What is said.

    Attributes:
        reason: Stable name of it, for pages that say it in another language.
        headline: To be read from a driver's seat.
        detail: A sentence.
        remedy: What to do about a problem.
    """

    reason: Reason
    headline: str
    detail: str = ""
    remedy: str = ""


PAUSED = {
    PauseReason.DISABLED: Words(
        PauseReason.DISABLED,
        "Guidance is off",
        "It is switched off in the settings.",
        "Set guidance.enabled to true.",
    ),
    PauseReason.ROBOT_OFFLINE: Words(
        PauseReason.ROBOT_OFFLINE,
        "No guidance now",
        "The robot does not answer, so nobody knows where its camera is.",
    ),
    PauseReason.ROBOT_BUSY: Words(
        PauseReason.ROBOT_BUSY, "No guidance now", "The robot is at work. Do not move the car."
    ),
    PauseReason.ROBOT_NOT_HOMED: Words(
        PauseReason.ROBOT_NOT_HOMED,
        "No guidance yet",
        "The robot does not know its own position, and so not its camera's.",
        "It finds its position when it next charges a car. You can also start that in the card "
        "“Robot”.",
    ),
    PauseReason.ROBOT_NOT_PARKED: Words(
        PauseReason.ROBOT_NOT_PARKED,
        "Do not drive in",
        "The robot is not in its parking place.",
        "Wait until it has parked, or move it there.",
    ),
    PauseReason.PLUG_HELD: Words(
        PauseReason.PLUG_HELD, "Do not move the car", "The plug is in it, or may be."
    ),
    PauseReason.CAMERA_DOWN: Words(
        PauseReason.CAMERA_DOWN,
        "No camera picture",
        "Without pictures nobody can say how far to go.",
        "Check the cable of the camera. Park by eye if you must.",
    ),
}

UNSEEN = {
    Unseen.NOTHING: Words(
        Unseen.NOTHING, "Waiting for a car", "The label beside its socket is not in view."
    ),
    Unseen.TOO_FAR: Words(
        Unseen.TOO_FAR, "Come nearer slowly", "The label is still too far away to be read."
    ),
    Unseen.TOO_DIRTY: Words(
        Unseen.TOO_DIRTY,
        "The label cannot be read",
        "It is dirty, damaged or partly covered.",
        "Stop, wipe the label, and drive on.",
    ),
    Unseen.TOO_DARK: Words(
        Unseen.TOO_DARK, "It is too dark", "The camera sees next to nothing.", "Switch a light on."
    ),
    Unseen.TOO_BRIGHT: Words(
        Unseen.TOO_BRIGHT,
        "It is too bright",
        "The camera is dazzled.",
        "Shade the camera, or dip the headlights.",
    ),
    Unseen.OTHER_LABEL: Words(
        Unseen.OTHER_LABEL,
        "This label is not known here",
        "It belongs to another car, or to another robot.",
        "Add the car first, or print its label with this robot.",
    ),
    Unseen.TWICE: Words(
        Unseen.TWICE,
        "Two labels are in view",
        "Both say that they are the same car.",
        "Take the copy away.",
    ),
    Unseen.MIRRORED: Words(
        Unseen.MIRRORED,
        "The label is mirrored",
        "The camera seems to look into a mirror.",
        "Take the mirror away.",
    ),
    Unseen.NO_VEHICLE: Words(
        Unseen.NO_VEHICLE,
        "No car is known yet",
        "The robot cannot tell whose label it sees.",
        "Add a car and print its label first.",
    ),
}

GOOD = Words(Outcome.GOOD, "Stop here", "The car stands well. You can get out.")
GOOD_FLAWED = Words(
    Outcome.GOOD_FLAWED,
    "Stop here",
    "The car stands well, but its label does not look as it should.",
    "Wipe the label before you charge.",
)
STOP = Words(Outcome.STOP, "Stop", "Brake now.")

_HEADLINES = {
    Direction.FORWARD: "{} forward",
    Direction.BACK: "{} back",
    Direction.LEFT: "{} to the left",
    Direction.RIGHT: "{} to the right",
    Direction.UP: "{} too low",
    Direction.DOWN: "{} too high",
}
_CLAUSES = {
    Direction.FORWARD: "{} forward",
    Direction.BACK: "{} back",
    Direction.LEFT: "{} further left",
    Direction.RIGHT: "{} further right",
}


_MANNERS = {
    Manner.ROLLS: "Straight on.",
    Manner.TOO_FAST: "Slow down.",
    Manner.ASKEW: "You are coming in askew: straighten up.",
    Manner.STANDS: "The robot cannot reach the socket yet.",
}


def distance(cm: int) -> str:
    """A distance as people say it: "8 cm", "1.2 m"."""
    return f"{cm} cm" if cm < 100 else f"{cm / 100:.1f} m"


def lost(edge: Direction | None) -> Words:
    """The label was there a moment ago; the edge says where it left the picture."""
    if edge is None:
        return Words(
            Outcome.HIDDEN,
            "Stop: the label is hidden",
            "It was in view a moment ago. Something covers it.",
            "Take away what is in front of it, or wipe it.",
        )
    reason, where = {
        Direction.LEFT: (Outcome.LEFT_AT_LEFT, "the socket is too far to the left"),
        Direction.RIGHT: (Outcome.LEFT_AT_RIGHT, "the socket is too far to the right"),
        Direction.UP: (Outcome.LEFT_AT_TOP, "the socket is too high"),
        Direction.DOWN: (Outcome.LEFT_AT_BOTTOM, "the socket is too low"),
    }[edge]
    return Words(
        reason,
        "Stop: the label left the picture",
        f"For the robot {where}.",
        "Back up a little, until it is seen again.",
    )


def move(steps: Sequence[Step], manner: Manner) -> Words:
    """What to do first, and what else."""
    first, *others = steps
    headline = _HEADLINES[first.direction].format(distance(first.shown_cm))
    if first.direction in {Direction.UP, Direction.DOWN}:
        low = first.direction is Direction.UP
        return Words(
            Outcome.TOO_LOW if low else Outcome.TOO_HIGH,
            f"The socket is {headline}",
            f"The robot cannot reach {'down' if low else 'up'} to it.",
            "No parking helps here: have the robot mounted "
            f"{'lower' if low else 'higher'}, or choose another robot.",
        )
    clauses = [
        _CLAUSES[step.direction].format(distance(step.shown_cm))
        for step in others
        if step.direction in _CLAUSES
    ]
    also = f"And {' and '.join(clauses)}." if clauses else ""
    said = _MANNERS[manner]
    if manner is Manner.ROLLS and also:
        said = ""
    sideways = {Direction.LEFT, Direction.RIGHT} & {step.direction for step in steps}
    remedy = ""
    if manner is Manner.STANDS and sideways:
        remedy = "Back up and come in again, aiming further over."
    return Words(manner, headline, f"{said} {also}".strip(), remedy)


def thin(steps: Sequence[Step]) -> Words:
    """Within reach, but near its edge."""
    better = " and ".join(
        _CLAUSES[step.direction].format(distance(step.shown_cm))
        for step in steps
        if step.direction in _CLAUSES
    )
    hint = f" Better: {better}." if better else ""
    return Words(Outcome.THIN, "Just within reach", f"You can stay, with little to spare.{hint}")


def skewed(skew_deg: float, limit_deg: float, turn: Direction | None) -> Words:
    """The plug cannot follow so much skew."""
    sentence = (
        f"The socket is turned {skew_deg:.0f}° away; the plug can follow {limit_deg:g}° at most."
    )
    if turn is None:
        return Words(
            Outcome.SKEWED,
            "The car stands askew",
            sentence,
            "Check that label and socket sit as they were taught.",
        )
    side = turn.value
    return Words(
        Outcome.SKEWED_LEFT if turn is Direction.LEFT else Outcome.SKEWED_RIGHT,
        "The car stands askew",
        sentence,
        f"Back up and come in straighter: the nose points too far to the {side}.",
    )
