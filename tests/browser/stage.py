"""A server that serves the built pages and shows them one fixed live state."""

from __future__ import annotations

import asyncio
import json
import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from datetime import timedelta
from pathlib import Path

import segno
import uvicorn
from fastapi import FastAPI, Request, WebSocket, WebSocketDisconnect
from fastapi.responses import HTMLResponse, JSONResponse, Response

from server.access import Role
from server.access.rights import ROLE_RIGHTS, Need
from server.api.pages import pages_router
from server.jobs.model import JobPhase, JobState
from server.schema.access import AccessSession, PersonSummary
from server.schema.jobs import JobPage, JobResult, Playback, PlaybackMark, RecordingInfo
from server.schema.live import DeltaMessage, Live, LiveChanges, SnapshotMessage
from server.schema.push import PushState, PushSubscription
from server.schema.robot import Reach, WayLeft
from server.schema.vehicles import Vehicle, VehicleList
from tests.browser import board_scene
from tests.browser.bench_scenes import answer, picture
from tests.browser.scenes import LABEL_NOT_FOUND, SCENES, job

STATIC_DIR = Path(__file__).resolve().parents[2] / "server" / "static"
BEAT_S = 0.1

PUSH_KEY = "BA1Hxzyi1RUM1b5wjxsn7nGxAszw2u61m164i3MrAIxHF6YK5h4SDYic-dRuU_RCPCfA5aq9ojSwk5Y2EmClBPs"

VEHICLES = VehicleList(
    items=[
        Vehicle(id="id3", name="Volkswagen ID.3", label_payload="PP2:id3:AAAAAAAAAA"),
        Vehicle(id="zoe", name="Renault Zoe", label_payload="PP2:zoe:AAAAAAAAAA"),
    ]
)

OWNER = AccessSession(
    paired=True,
    person=PersonSummary(id="anna", name="Anna", role=Role.OWNER, ends_at=None),
    device_id="phone",
    rights=sorted(ROLE_RIGHTS[Role.OWNER]),
    passkeys=False,
    screen=False,
)

STRANGER = AccessSession(
    paired=False, person=None, device_id=None, rights=[], passkeys=False, screen=False
)
ON_THE_ROBOT = STRANGER.model_copy(update={"rights": [Need.STOP]})
"""Nobody we know, at the robot's own screen; an owner there is."""
UNOWNED = ON_THE_ROBOT.model_copy(update={"screen": True})
"""The same before anybody owns the robot."""

PAST_JOB = job(
    JobPhase.PARKING,
    state=JobState.SUCCEEDED,
    result=JobResult(energy_wh=21_480, cost=6.44, currency="EUR"),
).model_copy(update={"recording": RecordingInfo(size_bytes=1_500_000)})
FAILED_JOB = job(
    JobPhase.LOCATING, state=JobState.FAILED, seconds=90_000, error=LABEL_NOT_FOUND
).model_copy(update={"id": "01956b1e-8c00-7000-8000-000000000003"})
PLAYBACK = Playback(
    duration_s=18.7,
    marks=[
        PlaybackMark(at_s=0, kind="phase", text="aligning"),
        PlaybackMark(at_s=3.3, kind="phase", text="inserting"),
        PlaybackMark(at_s=5.1, kind="divergence", text="The slide does not follow"),
        PlaybackMark(at_s=7.9, kind="phase", text="charging"),
        PlaybackMark(at_s=9.8, kind="phase", text="withdrawing"),
        PlaybackMark(at_s=14.4, kind="phase", text="parking"),
    ],
)


_WAY = WayLeft(back_mm=112.5, on_mm=207.0)
REACH = Reach(
    x=_WAY, y=_WAY, insertion=WayLeft(back_mm=0, on_mm=57.5), rho1=_WAY, rho2=_WAY, rho3=_WAY
)


class Stage:
    """What the pages are shown, and what they asked for.

    Attributes:
        live: The state that every page sees.
        requests: Method and path of every REST call, in order.
        session: Who looks at the page.
        subscription: Where the browser wants to be notified.
        stops: How many have come, either way. None is confirmed over the WebSocket.
        refuse_jobs: Answer new jobs with a problem.
    """

    def __init__(self, static_dir: Path = STATIC_DIR) -> None:
        self.live: Live = SCENES["ready"]
        self.session = OWNER
        self.requests: list[str] = []
        self.subscription: PushSubscription | None = None
        self.refuse_jobs = False
        self.stops = 0
        self.app = FastAPI()
        self.app.include_router(pages_router(static_dir))
        self.app.websocket("/api/v1/ws")(self._send_live)
        self.app.get("/api/v1/push")(self._push)
        self.app.put("/api/v1/push", status_code=204)(self._subscribe)
        self.app.delete("/api/v1/push", status_code=204)(self._unsubscribe)
        self.app.get("/api/v1/access/session")(self._session)
        self.app.get("/api/v1/vehicles")(self._vehicles)
        self.app.get("/api/v1/jobs")(self._jobs)
        self.app.get("/api/v1/jobs/{job_id}/playback")(self._playback)
        self.app.get("/api/v1/robot/reach")(self._reach)
        self.app.get("/twin/")(self._twin)
        self.app.get("/api/v1/camera/inspection/{name}")(self._picture)
        self.app.get("/api/v1/calibrations/routine/board/{name}")(self._board)
        self.app.get("/api/v1/{rest:path}")(self._example)
        self.app.post("/api/v1/access/owner-invitation")(self._invite)
        self.app.post("/api/v1/{rest:path}")(self._accept)

    async def _send_live(self, connection: WebSocket) -> None:
        await connection.accept()
        shown = self.live
        sequence = 1
        snapshot = SnapshotMessage(sequence=sequence, sent_s=_now_s(), live=shown)
        with suppress(WebSocketDisconnect):
            await connection.send_text(snapshot.model_dump_json())
            while True:
                with suppress(TimeoutError):
                    said = await asyncio.wait_for(connection.receive_text(), BEAT_S)
                    self.stops += json.loads(said)["type"] == "stop"
                sequence += 1
                changes = self._changes(shown, sequence)
                shown = self.live
                delta = DeltaMessage(sequence=sequence, sent_s=_now_s(), changes=changes)
                unchanged = set(LiveChanges.model_fields) - changes.model_fields_set
                await connection.send_text(delta.model_dump_json(exclude={"changes": unchanged}))

    def _changes(self, shown: Live, beat: int) -> LiveChanges:
        """What differs, and always the robot: its measurements never stand still."""
        updated_at = self.live.robot.updated_at + beat * timedelta(seconds=BEAT_S)
        robot = self.live.robot.model_copy(update={"updated_at": updated_at})
        differing = {
            name: getattr(self.live, name)
            for name in (
                "job",
                "station",
                "service",
                "twin",
                "queue",
                "guidance",
                "calibration",
                "control",
                "outlook",
            )
            if getattr(self.live, name) != getattr(shown, name)
        }
        return LiveChanges(robot=robot, **differing)

    async def _session(self) -> AccessSession:
        return self.session

    async def _invite(self) -> JSONResponse:
        address = "http://plugpilot.local:8000/#pair=Zk3vTq9xR2mB7wYc"
        drawn = segno.make(address, error="m").svg_data_uri(border=4, light="#fff")
        return JSONResponse(
            {"address": address, "qr": drawn, "reachable": True, "expires_at": None}
        )

    async def _push(self) -> PushState:
        return PushState(public_key=PUSH_KEY, subscribed=self.subscription is not None)

    async def _subscribe(self, wanted: PushSubscription) -> None:
        self.subscription = wanted

    async def _unsubscribe(self) -> None:
        self.subscription = None

    async def _vehicles(self) -> VehicleList:
        return VEHICLES

    async def _jobs(self) -> JobPage:
        return JobPage(items=[PAST_JOB, FAILED_JOB], next_cursor=None)

    async def _playback(self, job_id: str) -> Playback:
        assert job_id == PAST_JOB.id
        return PLAYBACK

    async def _reach(self) -> Reach:
        return REACH

    async def _twin(self) -> HTMLResponse:
        return HTMLResponse('<!doctype html><html lang="en"><title>3D</title><p>3D</p></html>')

    async def _picture(self, name: str) -> Response:
        del name
        return Response(picture(), media_type="image/jpeg")

    async def _board(self, name: str) -> Response:
        del name
        return Response(board_scene.picture(), media_type="image/jpeg")

    async def _example(self, rest: str) -> JSONResponse:
        await asyncio.sleep(BEAT_S)  # the page asks again and again
        found = answer(rest)
        return JSONResponse(found, 404 if found is None else 200)

    async def _accept(self, request: Request, rest: str) -> JSONResponse:
        self.requests.append(f"{request.method} /{rest}")
        self.stops += rest == "robot/stop"
        if rest == "jobs" and self.refuse_jobs:
            return JSONResponse(
                LABEL_NOT_FOUND.model_dump(), 409, media_type="application/problem+json"
            )
        return JSONResponse({}, 202)


def _now_s() -> float:
    return asyncio.get_running_loop().time()


@contextmanager
def serve(stage: Stage, port: int = 0) -> Iterator[str]:
    """Serves the stage from a thread of its own, at a free port or a given one.

    Gives its address.
    """
    listener = socket.create_server(("127.0.0.1", port))
    port = listener.getsockname()[1]
    config = uvicorn.Config(stage.app, log_level="warning", ws="websockets-sansio", lifespan="off")
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]})
    thread.start()
    try:
        yield f"http://127.0.0.1:{port}"
    finally:
        server.should_exit = True
        thread.join()
