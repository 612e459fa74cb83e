"""Errors of jobs.

JobError
├── JobQueueFullError        a job is running, and another one waits already
├── JobWaitsForPersonError   the running job has asked a person something
├── JobNotFoundError         no such job
├── JobEndedError            the job has ended and cannot be changed
├── JobCancelledError        somebody cancelled the job
├── JobInterruption          ends the phases for the time being (server/jobs/interruptions.py)
├── CannotPauseError         the job cannot be paused in this phase
├── NotPausedError           there is nothing to resume
├── ScheduleError            the times of a job contradict each other or the clock
├── ScheduleMissedError      it was too late to begin
├── NotChargingError         the job is not charging, so it cannot be finished
├── IdempotencyReuseError    the same key came with another request
├── UnknownVehicleError      no such vehicle
├── VehicleChoiceError       several vehicles, none chosen
├── VehicleInUseError        the vehicle's job is running
├── PlugStateError           the plug is not where the job needs it
├── JobInterruptedError      a restart left the job behind, and it cannot go on
├── SocketTooSkewedError     the car stands too skewed for the plug
├── InsertionJammedError     the plug did not go in
├── InsertionDepthError      the plug stopped at the wrong depth
├── PlugMissedError          the plug went where no socket is
├── NotConnectedError        the plug is in, but the station sees no car
├── StillLockedError         the connector did not let go
└── CarGoneError             the car left while it was plugged in
"""

from __future__ import annotations

from server.errors import PlugPilotError


class JobError(PlugPilotError):
    """A job cannot be done, or not be done further."""

    code = "job"
    title = "The job cannot be done"
    status = 409


class JobQueueFullError(JobError):
    """A job is running or set for later, and another one waits already."""

    code = "job_queue_full"
    title = "Another job is waiting already"
    remedy = "Wait until it has begun, or cancel it."


class JobWaitsForPersonError(JobError):
    """The running job has asked a person something, and nobody has answered."""

    code = "job_needs_person"
    title = "The running job waits for an answer"
    remedy = "Resume or cancel the running job first."


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


class CannotPauseError(JobError):
    """The job cannot be paused in this phase."""

    code = "cannot_pause"
    title = "The job cannot be paused now"
    remedy = "Wait until the plug is out. Stop works at any time."


class NotPausedError(JobError):
    """The job neither is paused nor waits for a person."""

    code = "not_paused"
    title = "There is nothing to resume"
    remedy = "Look at the job: it goes on by itself."


class ScheduleError(JobError):
    """The times of a job contradict each other or the clock."""

    code = "schedule"
    title = "These times do not fit together"
    status = 422
    remedy = "Choose a time in the future to unplug by, and an earlier one to begin."


class ScheduleMissedError(JobError):
    """It was too late to begin."""

    code = "schedule_missed"
    title = "It was too late to begin"
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
    """A restart left the job behind, and it cannot go on."""

    code = "interrupted"
    title = "The job was interrupted and cannot go on"
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


class PlugMissedError(JobError):
    """The plug went in as deep as it should, but met no socket there."""

    code = "plug_missed"
    title = "The plug met no socket"
    remedy = "Look whether the car has moved and the label sits where it was measured."


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


class CarGoneError(JobError):
    """The station lost the car, or the plug moved, while it should have rested in the socket."""

    code = "car_gone"
    title = "The plug is no longer where it was"
    remedy = (
        "Look at the robot and the car. If the plug hangs free, confirm that on the page; "
        "if it is still in, press Unplug."
    )
