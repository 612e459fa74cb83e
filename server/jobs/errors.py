"""Errors of jobs.

JobError
├── JobRunningError          another job is running
├── JobNotFoundError         no such job
├── JobEndedError            the job has ended and cannot be changed
├── JobCancelledError        somebody cancelled the job
├── NotChargingError         the job is not charging, so it cannot be finished
├── IdempotencyReuseError    the same key came with another request
├── UnknownVehicleError      no such vehicle
├── VehicleChoiceError       several vehicles, none chosen
├── VehicleInUseError        the vehicle's job is running
├── PlugStateError           the plug is not where the job needs it
├── JobInterruptedError      PlugPilot was restarted while the job ran
├── SocketTooSkewedError     the car stands too skewed for the plug
├── InsertionJammedError     the plug did not go in
├── InsertionDepthError      the plug stopped at the wrong depth
├── NotConnectedError        the plug is in, but the station sees no car
├── StillLockedError         the connector did not let go
├── StillUnderLoadError      current still flows, so the plug stays in
└── StationUnsafeError       the station does not answer or reports a fault
"""

from __future__ import annotations

from server.errors import PlugPilotError


class JobError(PlugPilotError):
    """A job cannot be done, or not be done further."""

    code = "job"
    title = "The job cannot be done"
    status = 409


class JobRunningError(JobError):
    """Another job is running."""

    code = "job_running"
    title = "The robot is already at work"
    remedy = "Wait until the running job has ended, or cancel it."


class JobNotFoundError(JobError):
    """There is no such job."""

    code = "job_not_found"
    title = "There is no such job"
    status = 404
    remedy = "Look at the list of jobs for the right id."


class JobEndedError(JobError):
    """The job has ended and cannot be changed."""

    code = "job_ended"
    title = "The job has already ended"
    remedy = "Start a new job."


class JobCancelledError(JobError):
    """Somebody cancelled the job; ends its phases, and is never shown."""

    code = "cancelled"
    title = "The job was cancelled"
    remedy = "Start a new job."


class NotChargingError(JobError):
    """The job is not charging, so there is nothing to finish."""

    code = "not_charging"
    title = "The car is not charging in this job"
    remedy = "Cancel the job instead."


class IdempotencyReuseError(JobError):
    """An Idempotency-Key came again with another request."""

    code = "idempotency_key_reused"
    title = "This Idempotency-Key belongs to another request"
    status = 422
    remedy = "Use a new key for a new request."


class UnknownVehicleError(JobError):
    """There is no such vehicle."""

    code = "unknown_vehicle"
    title = "This vehicle is not known"
    status = 404
    remedy = "Choose one of the known vehicles, or add this one first."


class VehicleChoiceError(JobError):
    """Several vehicles are known, and none was chosen."""

    code = "vehicle_required"
    title = "Which vehicle?"
    status = 422
    remedy = "Say which vehicle, by vehicle_id."


class VehicleInUseError(JobError):
    """The vehicle's job is running."""

    code = "vehicle_in_use"
    title = "The robot is working with this vehicle"
    remedy = "Wait until the job has ended."


class PlugStateError(JobError):
    """The plug is not where the job needs it."""

    code = "plug_state"
    title = "The plug is not where it should be"
    remedy = "Unplug first. If the plug hangs free, confirm that on the page."


class JobInterruptedError(JobError):
    """PlugPilot was restarted while the job ran."""

    code = "interrupted"
    title = "PlugPilot was restarted during the job"
    status = 500
    remedy = "Look at the robot. If the plug is in the car, unplug; otherwise start again."


class SocketTooSkewedError(JobError):
    """The socket is tilted more than the plug holder can follow."""

    code = "socket_too_skewed"
    title = "The car stands too skewed"
    remedy = "Park the car straighter and try again."


class InsertionJammedError(JobError):
    """The plug did not go in."""

    code = "insertion_jammed"
    title = "The plug did not go in"
    remedy = "Check that the flap is open and nothing is in the socket, then try again."


class InsertionDepthError(JobError):
    """The plug stopped at the wrong depth."""

    code = "insertion_depth"
    title = "The plug is not fully in"
    remedy = "Unplug, check the socket, and try again."


class NotConnectedError(JobError):
    """The plug is in, but the station sees no car."""

    code = "no_contact"
    title = "The station does not see the car"
    remedy = "Unplug and try again. If it comes back, check plug, cable and station."


class StillLockedError(JobError):
    """The connector did not let go."""

    code = "connector_locked"
    title = "The car still holds the plug"
    remedy = "Unlock the car, then press Unplug again."


class StillUnderLoadError(JobError):
    """Current still flows, so the plug stays in."""

    code = "under_load"
    title = "The charging current does not stop"
    remedy = "Switch the charging station off, then press Unplug again."


class StationUnsafeError(JobError):
    """The station does not answer or reports a fault."""

    code = "station_unsafe"
    title = "The charging station does not answer as it should"
    status = 502
    remedy = "Check that the charging station has power and is connected to the network."
