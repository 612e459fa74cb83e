"""Who is in control, as the API shows it."""

from __future__ import annotations

from server.access.rights import Role
from server.control.seat import ControlSeat, Operator
from server.schema import control as wire


def control_view(seat: ControlSeat) -> wire.Control:
    """Who is in control now, and who asks."""
    holder, request, answer = seat.holder, seat.request, seat.answer
    return wire.Control(
        holder=wire.ControlSeat(
            person=_person(holder.operator), since=holder.since, ends_at=holder.ends_at
        )
        if holder
        else None,
        request=wire.ControlRequest(
            id=request.id,
            person=_person(request.operator),
            asked_at=request.asked_at,
            ends_at=request.ends_at,
        )
        if request
        else None,
        answer=wire.ControlAnswer(
            request_id=answer.request.id,
            person=_person(answer.request.operator),
            by=_person(answer.by),
            answer=answer.answer,
            at=answer.at,
        )
        if answer
        else None,
    )


def _person(operator: Operator) -> wire.ControlPerson:
    return wire.ControlPerson(id=operator.id, name=operator.name, role=Role(operator.role))
