"""The robot with its station as one charger: flat, for energy managers such as evcc."""

from __future__ import annotations

from fastapi import APIRouter

from server.api.dependencies import ServicesDep
from server.api.problems import problem_responses
from server.schema.charge_point import ChargePoint, CurrentLimit, Enablement

router = APIRouter(prefix="/charge-point", tags=["charge point"])


@router.get("", operation_id="getChargePoint", summary="Read the charger")
async def get_charge_point(services: ServicesDep) -> ChargePoint:
    """State, power and energy, from the newest reading of the station.

    A parked car counts as connected (B) before the plug is in: energy managers never enable a
    charger without a car. After somebody has unplugged the car, or it has charged, the charger
    reports A until it is resumed.
    """
    return services.charge_point.view()


@router.put(
    "/enabled",
    operation_id="enableChargePoint",
    summary="Let the car charge, or no more",
    responses=problem_responses(404, 409, 422, 502, 503),
)
async def put_enabled(wanted: Enablement, services: ServicesDep) -> ChargePoint:
    """Enabled, the robot plugs the car in if needed, and lets it charge.

    Disabled, the car gets no energy but stays plugged in. Answers at once; the state shows how far
    it is. The same value again changes nothing.
    """
    return await services.charge_point.set_enabled(enabled=wanted.enabled)


@router.put(
    "/max-current",
    operation_id="limitChargePoint",
    summary="Limit the current",
    responses=problem_responses(422, 502),
)
async def put_max_current(limit: CurrentLimit, services: ServicesDep) -> ChargePoint:
    """Passed on to stations that can; `limits_current` says whether ours does."""
    return await services.charge_point.limit_current(limit.max_current_a)


@router.post(
    "/resume",
    operation_id="resumeChargePoint",
    summary="End the rest",
)
async def resume(services: ServicesDep) -> ChargePoint:
    """A person, or something that knows that the car has come, lets it be plugged in again.

    Nothing moves before the energy manager enables the charger.
    """
    return services.charge_point.resume()
