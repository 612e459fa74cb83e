"""All routines, described for whoever shows them to people."""

from __future__ import annotations

from server.schema.routines import RoutineDescription, RoutineSetting

CAR_STANDS = "Let a car with a label stand before the robot, with the brake on."
PLUG_FREE = "Let the plug hang freely at the robot."


def _approaches(usual: float) -> RoutineSetting:
    return RoutineSetting(
        name="approaches", label="Approaches", unit="", least=3, most=30, usual=usual, whole=True
    )


def _number(
    name: str, label: str, unit: str, bounds: tuple[float, float], usual: float | None
) -> RoutineSetting:
    least, most = bounds
    return RoutineSetting(
        name=name, label=label, unit=unit, least=least, most=most, usual=usual, whole=False
    )


ROUTINES = (
    RoutineDescription(
        kind="camera",
        title="Camera",
        what="Looks while you hold the printed board before the camera, and says what to do next.",
        before=[
            "Print the board with `plugpilot label --board`, and glue it onto something flat.",
            "Measure the side of a square, best over several of them.",
            "Bring the robot to where you reach the camera, and stand so that you see this page.",
        ],
        needs_label=False,
        settings=[_number("square_mm", "Side of a square", "mm", (5, 200), 24)],
    ),
    RoutineDescription(
        kind="switches",
        title="Limit switches",
        what="Homes again and again, and looks each time by how much the robot then stands "
        "elsewhere.",
        before=[CAR_STANDS, PLUG_FREE],
        needs_label=True,
        settings=[_approaches(5)],
    ),
    RoutineDescription(
        kind="play",
        title="Play of the carriages",
        what="Brings each carriage to the same place from both sides, and looks by how much the "
        "robot then stands elsewhere.",
        before=[CAR_STANDS, PLUG_FREE],
        needs_label=True,
        settings=[_approaches(4)],
    ),
    RoutineDescription(
        kind="belts",
        title="Travel of the belts",
        what="Moves both carriages along the rail, and asks how far they really went.",
        before=[PLUG_FREE, "Have a rule of half a metre and a pencil at hand."],
        needs_label=False,
        settings=[
            _number("distance_mm", "Distance", "mm", (50, 400), 300),
            _number("reading_sigma_mm", "Reading is good to", "mm", (0.01, 2), 0.1),
        ],
    ),
    RoutineDescription(
        kind="robot",
        title="Robot",
        what="Looks at the label from 25 places, and works out how the robot is built.",
        before=[CAR_STANDS, PLUG_FREE, "Measure the belts first: all scale comes from there."],
        needs_label=True,
        settings=[_number("label_sigma_mm", "Label is measured to", "mm", (0.01, 2), 0.15)],
    ),
    RoutineDescription(
        kind="force",
        title="Force of the slide",
        what="Moves the slide freely and, if there is a spring, against it: friction and force "
        "scale.",
        before=[PLUG_FREE, "Keep cars and hands away from the plug."],
        needs_label=False,
        settings=[
            RoutineSetting(
                name="strokes", label="Strokes", unit="", least=2, most=20, usual=3, whole=True
            ),
            _number("stroke_mm", "Stroke", "mm", (5, 100), 12),
            _number("spring_n_mm", "Rate of the spring", "N/mm", (0.1, 50), None),
            _number("spring_sigma", "Rate is known to this share", "", (0.001, 0.2), 0.02),
        ],
    ),
    RoutineDescription(
        kind="socket",
        title="Teach a socket",
        what="Looks at the label, draws the plug out, and looks again.",
        before=[CAR_STANDS, "Bring the plug all the way into the socket, by jogging or by a job."],
        needs_label=True,
        settings=[],
    ),
    RoutineDescription(
        kind="check",
        title="Nine-point check",
        what="Goes to nine places from both sides, and measures how exactly it comes there "
        "(ISO 9283).",
        before=[CAR_STANDS, PLUG_FREE, "Let the label stand in the middle of the reach."],
        needs_label=True,
        settings=[_approaches(3)],
    ),
)
