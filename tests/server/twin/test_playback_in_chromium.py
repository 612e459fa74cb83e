"""A recorded job in a real browser: the 3D client plays it, the page around it has the player."""

from __future__ import annotations

import asyncio
import contextlib
import socket
from collections.abc import AsyncIterator
from pathlib import Path

import pytest
import uvicorn
from fastapi import FastAPI
from fastapi.responses import FileResponse, HTMLResponse
from playwright.async_api import Browser, Page

from server.api.twin import twin_router
from tests.support.eventually import eventually
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import gamma
from twin.scene import TwinHost, TwinState
from twin.scene.playback import PlaybackFrame, build_playback
from twin.statics import ActuatorLimits, Loads, SagTables

pytestmark = pytest.mark.browser

BEGIN = JointPosition(200.0, 200.0, 60.0)
END = JointPosition(260.0, 180.0, 90.0)
LENGTH_S = 600.0
"""So long that nothing happens by itself while a busy machine looks."""

AROUND = """<!doctype html><title>around</title><body style="margin:0">
<iframe src="/twin/?playbackPath=%2Fa.viser&fixedDpr=0.25"
  style="border:0;width:160px;height:120px"></iframe>
<script>
window.said = [];
addEventListener("message", (e) => { if (e.data.playback) said.push(e.data.playback); });
window.tell = (player) => frames[0].postMessage({ player }, location.origin);
</script>"""


def states() -> list[PlaybackFrame]:
    """At the beginning, after a hundred seconds at the end and with an alarm, and so on."""
    return [
        PlaybackFrame(0.0, TwinState(measured=BEGIN)),
        PlaybackFrame(100.0, TwinState(measured=END, parted=("rho1", "force"))),
        PlaybackFrame(LENGTH_S, TwinState(measured=END)),
    ]


@contextlib.asynccontextmanager
async def serve(host: TwinHost, file: Path) -> AsyncIterator[str]:
    """The picture's routes, a playback and a page around them."""
    app = FastAPI()
    app.include_router(twin_router(host))
    app.get("/a.viser")(lambda: FileResponse(file))
    app.get("/around")(lambda: HTMLResponse(AROUND))
    listener = socket.create_server(("127.0.0.1", 0))
    config = uvicorn.Config(app, log_config=None, ws="websockets-sansio")
    server = uvicorn.Server(config)
    running = asyncio.create_task(server.serve(sockets=[listener]))
    try:
        await eventually(lambda: server.started)
        yield f"http://127.0.0.1:{listener.getsockname()[1]}"
    finally:
        server.should_exit = True
        await asyncio.wait_for(running, 10)
        listener.close()


async def until(page: Page, condition: str) -> None:
    """Wait until a condition holds in the frame or around it.

    Asked from here: the page's policy forbids the evaluation a wait inside it would need.
    """
    async with asyncio.timeout(60):
        while not await page.evaluate(condition):  # noqa: ASYNC110 - a page sends no events here
            await asyncio.sleep(0.1)


def platform_is_at(joints: JointPosition) -> str:
    x_mm, y_mm = gamma.platform(RobotGeometry(), joints)
    return (
        "(() => { const p = frames[0].__viserMutable?.nodePoseData?.['/robot/platform']?.position;"
        f" return p && Math.hypot(p[0] - {x_mm / 1000}, p[1] - {y_mm / 1000}) < 1e-5; }})()"
    )


RING_IS = "frames[0].__viserSceneTree.getState()['/robot/left_carriage/parted']?.visibility === {}"


async def make_playback(folder: Path) -> Path:
    file = folder / "a.viser"
    file.write_bytes(
        await asyncio.to_thread(
            build_playback,
            RobotGeometry(),
            CameraMount(),
            hfov_rad=1.0,
            aspect=4 / 3,
            loads=Loads(),
            limits=ActuatorLimits(),
            sag=SagTables(),
            frames=states(),
        )
    )
    return file


async def test_in_a_window_of_its_own_it_has_a_player_and_needs_no_live_picture(
    chromium: Browser, tmp_path: Path
) -> None:
    never_started = TwinHost(RobotGeometry(), CameraMount(), 1.0, 4 / 3)
    async with serve(never_started, await make_playback(tmp_path)) as address:
        page = await chromium.new_page(viewport={"width": 320, "height": 240})
        faults: list[str] = []
        page.on("pageerror", lambda e: faults.append(str(e)))
        await page.goto(f"{address}/twin/?playbackPath=%2Fa.viser&fixedDpr=0.25")
        player = page.locator("#twin-player")
        await player.wait_for(timeout=60_000)
        assert await page.locator("input.mantine-NumberInput-input:visible").count() == 0

        await player.get_by_role("slider").fill("150")
        here = "frames.length === 0 && " + platform_is_at(END).replace("frames[0].", "window.")
        await until(page, here)
        await player.get_by_role("button", name="Play").click()  # a jump has paused it
        await player.get_by_role("button", name="Pause").click()
        await player.get_by_role("button", name="Play").wait_for()
        assert " / 10:00" in await player.locator("output").inner_text()
        await player.get_by_role("slider").fill("20")
        await until(page, platform_is_at(BEGIN).replace("frames[0].", "window."))
        assert await player.locator("output").inner_text() == "0:20 / 10:00"
        assert faults == []


async def test_a_playback_plays_jumps_pauses_and_shows_what_has_parted(
    chromium: Browser, host: TwinHost, tmp_path: Path
) -> None:
    file = await make_playback(tmp_path)
    async with serve(host, file) as address:
        page = await chromium.new_page(viewport={"width": 200, "height": 160})
        faults: list[str] = []
        sockets: list[str] = []
        page.on("pageerror", lambda e: faults.append(str(e)))
        page.on("websocket", lambda ws: sockets.append(ws.url))
        await page.goto(f"{address}/around")

        await until(page, "said.at(-1)?.playing === true && said.at(-1).at > 0")
        await until(page, platform_is_at(BEGIN))
        frame = page.frames[1]
        assert await frame.locator("input.mantine-NumberInput-input:visible").count() == 0

        await page.evaluate("tell({ at: 150, playing: true })")
        await until(page, "said.at(-1).playing && said.at(-1).at > 150")
        await until(page, platform_is_at(END))
        await until(page, RING_IS.format("true"))

        await page.evaluate("tell({ playing: false })")
        await until(page, "said.at(-1).playing === false")

        await page.evaluate("tell({ at: 20 })")
        await until(page, "said.at(-1).at === 20 && !said.at(-1).playing")
        await until(page, platform_is_at(BEGIN))
        await until(page, RING_IS.format("false"))
        assert faults == []
        assert sockets == []
