"""Click-to-move: a place is planned and checked here; the motion itself needs a held button."""

from __future__ import annotations

import math

import numpy as np
from fastapi import APIRouter, Response

from server.api.dependencies import ServicesDep
from server.api.problems import problem_responses
from server.control.targets import Target
from server.schema.robot import Joints, Tip
from server.schema.target import ActuatorForce, MoveTarget, TargetRequest
from twin.geometry import RobotGeometry
from twin.joints import JointPosition, TipPosition
from twin.kinematics import gamma

router = APIRouter(prefix="/robot/target", tags=["robot"])

WAY_POINTS = 25


@router.post(
    "",
    operation_id="chooseTarget",
    summary="Plan a way to a place",
    responses=problem_responses(409, 503),
)
async def choose(request: TargetRequest, services: ServicesDep) -> MoveTarget:
    """Plan and check the straight way of the plug's tip to a place. Nothing moves."""
    target = await services.technician.targets.choose(
        request.x_mm, request.y_mm, request.speed_mm_s
    )
    return _shown(services.supervisor.geometry, target)


@router.delete("", status_code=204, operation_id="forgetTarget", summary="Forget the place")
async def forget(services: ServicesDep) -> Response:
    """Nobody wants to go there any more."""
    services.technician.targets.forget()
    return Response(status_code=204)


def _shown(geometry: RobotGeometry, target: Target) -> MoveTarget:
    plan = target.plan
    times_s = np.linspace(0.0, plan.duration_s, WAY_POINTS)
    joints = plan.sample(times_s).position_mm
    way = [gamma.forward(geometry, JointPosition(*map(float, row))) for row in joints]
    end = plan.end.position
    forces = (target.forces.rho1, target.forces.rho2, target.forces.rho3)
    return MoveTarget(
        id=target.id,
        tip=_tip(target.tip),
        joints=Joints(
            rho1_mm=round(end.rho1_mm, 3),
            rho2_mm=round(end.rho2_mm, 3),
            rho3_mm=round(end.rho3_mm, 3),
        ),
        way=[_tip(tip) for tip in way],
        distance_mm=round(math.dist(way[0], way[-1]), 3),
        duration_s=round(plan.duration_s, 3),
        forces=[
            ActuatorForce(
                joint=worst.joint,
                force_n=round(worst.force_n, 1),
                limit_n=worst.limit_n,
                share=round(worst.utilisation, 4),
                at_s=round(worst.time_s, 3),
            )
            for worst in forces
        ],
    )


def _tip(tip: TipPosition) -> Tip:
    return Tip(x_mm=round(tip.x_mm, 3), y_mm=round(tip.y_mm, 3), z_mm=round(tip.z_mm, 3))
