"""What becomes of control goes into the audit trail, also where nobody answers."""

from __future__ import annotations

from server.access.audit import OPERATION
from server.control.seat import ControlAnswer
from server.services import Services


def note_control(services: Services) -> None:
    """Write down from now on who asked for control, and what came of it."""

    def note(answer: ControlAnswer) -> None:
        asker, holder = answer.request.operator, answer.by
        actor = asker if answer.answer == "withdrawn" else holder
        services.access.audit.record(
            OPERATION,
            actor=f"person: {actor.name}",
            address="",
            operation=f"control {answer.answer}",
            name=asker.name,
        )

    services.seat.listen_to_answers(note)
