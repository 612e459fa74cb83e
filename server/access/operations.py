"""The one table that says what each operation needs.

An operation of the API is named by its operationId, any other route by its method and path, a
message by its type. What does not stand here is refused for everybody, and a test names it.
"""

from __future__ import annotations

from collections.abc import Mapping

from server.access.rights import Need, Rights

OPERATIONS: Mapping[str, Need] = {
    # pages
    "GET /": Need.ANYONE,
    "GET /technician": Need.ANYONE,
    "GET /kiosk": Need.ANYONE,
    "GET /assets/{name}": Need.ANYONE,
    "GET /icons/{name}": Need.ANYONE,
    "GET /manifest.webmanifest": Need.ANYONE,
    "GET /worker.js": Need.ANYONE,
    "GET /root.crt": Need.ANYONE,
    "GET /api/v1/openapi.json": Need.READ,
    # the 3D picture
    "GET /twin": Need.READ,
    "GET /twin/": Need.READ,
    "GET /twin/client.bin": Need.READ,
    "GET /twin/camera.jpg": Need.READ,
    "WEBSOCKET /twin": Need.READ,
    "WEBSOCKET /twin/": Need.READ,
    # service
    "getHealth": Need.ANYONE,
    "WEBSOCKET /api/v1/ws": Need.READ,
    # robot
    "getRobot": Need.READ,
    "stopRobot": Need.STOP,
    "emergencyStopRobot": Need.STOP,
    "resetRobot": Need.OPERATE,
    "enableRobot": Need.OPERATE,
    "disableRobot": Need.OPERATE,
    "homeRobot": Need.OPERATE,
    "getControl": Need.READ,
    "askForControl": Need.OPERATE,
    "withdrawControlRequest": Need.OPERATE,
    "answerControlRequest": Need.OPERATE,
    "giveControlBack": Need.OPERATE,
    "getRobotReach": Need.READ,
    "getRobotLink": Need.READ,
    "jogRobot": Need.SERVICE,
    "confirmPlug": Need.OPERATE,
    "readFrames": Need.SERVICE,
    "chooseTarget": Need.SERVICE,
    "forgetTarget": Need.SERVICE,
    # jobs
    "createJob": Need.OPERATE,
    "listJobs": Need.READ,
    "getJob": Need.READ,
    "cancelJob": Need.OPERATE,
    "pauseJob": Need.OPERATE,
    "resumeJob": Need.OPERATE,
    "finishJob": Need.OPERATE,
    "listJobEvents": Need.READ,
    "getOutlook": Need.READ,
    "getJobRecording": Need.READ,
    "getJobPlayback": Need.READ,
    "getJobPlaybackFile": Need.READ,
    # vehicles, station, camera
    "listVehicles": Need.READ,
    "getVehicle": Need.READ,
    "putVehicle": Need.SERVICE,
    "deleteVehicle": Need.SERVICE,
    "getStation": Need.READ,
    "getCameraSnapshot": Need.READ,
    "streamCamera": Need.READ,
    "inspectCamera": Need.READ,
    "getInspectedPicture": Need.READ,
    # calibration
    "listCalibrations": Need.READ,
    "getCalibration": Need.READ,
    "getCalibrationNow": Need.READ,
    "listAccuracyChecks": Need.READ,
    "getAccuracyReport": Need.READ,
    "getDrift": Need.READ,
    "listRoutines": Need.READ,
    "watchBoard": Need.READ,
    "getBoardSheet": Need.READ,
    "getBoardPicture": Need.READ,
    "keepCalibration": Need.SERVICE,
    "activateCalibration": Need.SERVICE,
    "rollBackCalibration": Need.SERVICE,
    "beginCalibration": Need.SERVICE,
    "confirmCalibration": Need.SERVICE,
    "resumeCalibration": Need.SERVICE,
    "cancelCalibration": Need.SERVICE,
    # arriving cars
    "getGuidance": Need.READ,
    "getSimulatedCar": Need.READ,
    "commandSimulatedCar": Need.SERVICE,
    "getSimulatedBoard": Need.READ,
    "commandSimulatedBoard": Need.SERVICE,
    # energy managers and other programs
    "getChargePoint": Need.CHARGE_POINT,
    "enableChargePoint": Need.CHARGE_POINT,
    "limitChargePoint": Need.CHARGE_POINT,
    "resumeChargePoint": Need.CHARGE_POINT,
    "listEvents": Need.READ,
    "streamEvents": Need.READ,
    "listWebhooks": Need.ADMIN,
    "createWebhook": Need.ADMIN,
    "getWebhook": Need.ADMIN,
    "putWebhook": Need.ADMIN,
    "deleteWebhook": Need.ADMIN,
    "pingWebhook": Need.ADMIN,
    "rotateWebhookSecret": Need.ADMIN,
    "listWebhookDeliveries": Need.ADMIN,
    "getConfig": Need.ADMIN,
    "patchConfig": Need.ADMIN,
    "getConfigFields": Need.ADMIN,
    "checkConfig": Need.ADMIN,
    "listConfigVersions": Need.ADMIN,
    "restoreConfig": Need.ADMIN,
    "getVersions": Need.READ,
    "getDiagnostics": Need.ADMIN,
    # oneself, and getting in
    "getSession": Need.ANYONE,
    "pairDevice": Need.ANYONE,
    "endSession": Need.PERSON,
    "inviteOwnDevice": Need.PERSON,
    "showOwnerInvitation": Need.ANYONE,  # on the robot's own screen only, while nobody owns it
    "listOwnPasskeys": Need.PERSON,
    "beginPasskey": Need.PERSON,
    "addPasskey": Need.PERSON,
    "removePasskey": Need.PERSON,
    "beginLogin": Need.ANYONE,
    "logIn": Need.ANYONE,
    "getPush": Need.PERSON,
    "subscribePush": Need.PERSON,
    "unsubscribePush": Need.PERSON,
    # everybody who is known
    "listPeople": Need.ADMIN,
    "changePerson": Need.ADMIN,
    "removePerson": Need.ADMIN,
    "removeDevice": Need.ADMIN,
    "listInvitations": Need.ADMIN,
    "createInvitation": Need.ADMIN,
    "withdrawInvitation": Need.ADMIN,
    "listKeys": Need.ADMIN,
    "createKey": Need.ADMIN,
    "revokeKey": Need.ADMIN,
    "listAudit": Need.ADMIN,
    "exportAudit": Need.ADMIN,
}

MESSAGES: Mapping[str, Need] = {
    "stop": Need.STOP,
    "emergency_stop": Need.STOP,
    "jog": Need.SERVICE,
    "jog_step": Need.SERVICE,
    "move_to": Need.SERVICE,
    "jog_end": Need.SERVICE,
    "resync": Need.READ,
}
"""Messages of clients on the WebSocket /api/v1/ws, by type."""

JOB_COMMANDS = frozenset({"createJob", "cancelJob", "pauseJob", "resumeJob", "finishJob"})

COMMANDS = JOB_COMMANDS | frozenset(
    {
        "enableRobot",
        "disableRobot",
        "homeRobot",
        "jogRobot",
        "confirmPlug",
        "message jog",
        "message jog_step",
        "message move_to",
        "activateCalibration",
        "rollBackCalibration",
        "beginCalibration",
        "confirmCalibration",
        "resumeCalibration",
        "cancelCalibration",
    }
)
"""What commands the robot. Whoever does is in control afterwards; while another person is, they are
refused. A stop and its release are for everybody who has the right to them."""

TWIN_MESSAGES: Mapping[str, Need] = {"ViewerCameraMessage": Need.READ}
"""Messages of the 3D client that may pass, by type. All others are dropped: none of them is needed
to look at the picture, and one of them opens a public tunnel."""

LARGE_BODIES: Mapping[str, int] = {}
"""Operations whose requests may be longer than the usual limit, with their own [bytes]."""

LIMITED = frozenset({"pairDevice", "beginLogin", "logIn"})
"""What somebody unknown may try only so often."""

STOPS = frozenset(name for name, need in OPERATIONS.items() if need is Need.STOP)
"""Never limited, never slowed, and open to the machine itself without any pairing."""

FREQUENT = STOPS | {"jogRobot"}
"""In the audit trail one entry for each burst of these; of other operations one for each."""

TOLD = frozenset(
    {"inviteOwnDevice", "createInvitation", "withdrawInvitation", "addPasskey", "removePasskey"}
)
"""Where they succeed, whoever carries them out tells the audit trail more than their name."""


def twin_messages(rights: Rights) -> frozenset[str]:
    """Types of messages that a browser with these rights may send to the 3D picture."""
    return frozenset(kind for kind, need in TWIN_MESSAGES.items() if need in rights)
