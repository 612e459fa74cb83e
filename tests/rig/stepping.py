"""What recorded steps tell: speeds, when a brake began, when the carriage stood."""

from __future__ import annotations

from collections.abc import Sequence

from tests.rig.truth import Step

CRUISE_S = 0.05
"""The speed before an event is taken over this time."""

OFF_COURSE_STEPS = 1.5
"""Further away from a steady motion than that a carriage does not move steadily any more; rounding
to ticks and steps explains one step."""


def steps_after(steps: Sequence[Step], at_s: float) -> list[Step]:
    """Steps later than an instant."""
    return [step for step in steps if step.at_s > at_s]


def speed_steps_s(steps: Sequence[Step]) -> float:
    """Mean speed from the first to the last of some steps."""
    return (steps[-1].position - steps[0].position) / (steps[-1].at_s - steps[0].at_s)


def braking_begins_s(steps: Sequence[Step], event_s: float) -> float:
    """When a carriage that moved steadily leaves its course after an event.

    That is noticed only when it is off course by a step and a half, so the true beginning is a
    little earlier: at 1500 mm/s^2 and 227 steps/mm by 3 ms.
    """
    cruise = [step for step in steps if event_s - CRUISE_S <= step.at_s <= event_s]
    speed = speed_steps_s(cruise)
    middle_s = sum(step.at_s for step in cruise) / len(cruise)
    middle = sum(step.position for step in cruise) / len(cruise)
    for step in steps_after(steps, event_s):
        course = middle + speed * (step.at_s - middle_s)
        if abs(step.position - course) > OFF_COURSE_STEPS:
            return step.at_s
    raise AssertionError("it never left its course")
