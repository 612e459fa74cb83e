"""The picture in a real browser."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable
from typing import Any, Literal

import cv2
import numpy as np
import pytest
import pytest_asyncio
from playwright.async_api import Browser, Page, Request, Route, ViewportSize

from tests.server.twin.conftest import Serve
from tests.support.eventually import eventually
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import gamma
from twin.scene import TwinHost, TwinState

pytestmark = pytest.mark.browser

SMALL: ViewportSize = {"width": 160, "height": 120}
"""Software graphics are slow."""
HOME = JointPosition(200.0, 200.0, 60.0)
PICTURE = "/robot/platform/camera/view/picture"
NODES = [
    "/robot/left_carriage/bar_ab",
    "/robot/platform/plug",
    "/car/inlet",
    "/label",
    "/cable",
    "/overlays/box/edges",
]


@pytest_asyncio.fixture
async def picture_address(host: TwinHost, serve: Serve) -> AsyncIterator[str]:
    """Where the 3D picture is served."""
    async with serve(host) as address:
        yield address


async def open_twin(browser: Browser, address: str, path: str = "/twin/") -> Page:
    page = await browser.new_page(viewport=SMALL)
    joiner = "&" if "?" in path else "?"
    await page.goto(f"http://{address}{path}{joiner}fixedDpr=0.25")
    return page


async def position_of(page: Page, node: str) -> list[float]:
    position: list[float] = await page.evaluate(
        "name => [...(window.__viserMutable.nodePoseData[name]?.position ?? [])]", node
    )
    return position


async def until_at(page: Page, node: str, expected_m: tuple[float, float, float]) -> None:
    """Waits until a node is drawn where it should be."""

    async def is_there() -> bool:
        return bool(await position_of(page, node) == pytest.approx(list(expected_m), abs=1e-6))

    await eventually(is_there, within_s=15)


def platform_m(joints: JointPosition) -> tuple[float, float, float]:
    x, y = gamma.platform(RobotGeometry(), joints)
    return x / 1000, y / 1000, 0.0


async def test_it_shows_the_robot_and_follows_it(
    chromium: Browser, host: TwinHost, serve: Serve
) -> None:
    host.publish(TwinState(measured=HOME))
    async with serve(host) as address:
        faults: list[str] = []
        asked: list[str] = []
        page = await chromium.new_page(viewport=SMALL)
        page.on("console", lambda m: faults.append(m.text) if m.type == "error" else None)
        page.on("pageerror", lambda e: faults.append(str(e)))
        page.on("request", lambda r: asked.append(r.url))
        await page.goto(f"http://{address}/twin/?fixedDpr=0.25")
        await page.wait_for_selector("html[data-twin=live]", state="attached", timeout=30_000)
        await until_at(page, "/robot/platform", platform_m(HOME))

        tree: dict[str, Any] = await page.evaluate("() => window.__viserSceneTree.getState()")
        assert set(NODES) <= set(tree)
        assert await page.locator("canvas").count() >= 1
        assert await page.locator("[data-floating-window]:visible").count() == 0

        moved = HOME._replace(rho1_mm=260.0, rho3_mm=90.0)
        host.publish(TwinState(measured=moved))
        await until_at(page, "/robot/platform", platform_m(moved))

        assert faults == []
        assert all(url.startswith((f"http://{address}/", "data:", "blob:")) for url in asked)


async def test_the_page_around_hears_that_it_lives_and_that_it_died(
    chromium: Browser, host: TwinHost, serve: Serve
) -> None:
    async with serve(host) as address:
        page = await open_twin(chromium, address, "/around")

        async def until_said(word: str) -> None:
            async def is_said() -> bool:
                return bool(await page.evaluate("() => said.at(-1)") == word)

            await eventually(is_said, within_s=30)

        await until_said("live")
        await asyncio.to_thread(host.stop)
        await until_said("stale")
        # An untouched frame has no focus, and yet it comes back by itself.
        host.start()
        await until_said("live")


@pytest.mark.parametrize(
    ("preferred", "query", "shown"),
    [("dark", "", "dark"), ("light", "", "light"), ("light", "?theme=dark", "dark")],
)
async def test_it_is_as_light_as_the_browser_unless_the_address_says_otherwise(
    picture_address: str,
    chromium: Browser,
    preferred: Literal["dark", "light"],
    query: str,
    shown: str,
) -> None:
    page = await chromium.new_page(viewport=SMALL, color_scheme=preferred)
    await page.goto(f"http://{picture_address}/twin/{query}")
    await page.wait_for_selector("canvas", state="attached", timeout=30_000)
    assert await page.get_attribute("html", "data-mantine-color-scheme") == shown


async def test_layers_are_switched_by_each_viewer_for_himself(
    chromium: Browser, host: TwinHost, serve: Serve
) -> None:
    host.publish(TwinState(measured=HOME))
    async with serve(host) as address:
        mine = await chromium.new_context(viewport=SMALL)
        page = await mine.new_page()
        received = watch_bytes(page)
        await page.goto(f"http://{address}/twin/?fixedDpr=0.25")
        await until_shown(page, "/overlays/path", shown=True)
        await until_shown(page, "/overlays/condition/map", shown=False)
        assert await received() < 700_000

        await page.locator("#twin-bar button").first.click()
        # Beyond the edge of this small window: clicked as a keyboard would.
        await page.locator("[data-layer=condition]").dispatch_event("click")
        await page.locator("[data-layer=path]").dispatch_event("click")
        await until_shown(page, "/overlays/condition/map", shown=True)
        await until_shown(page, "/overlays/path", shown=False)

        kept = await page.evaluate("() => JSON.parse(localStorage['plugpilot.twin.layers'])")
        assert kept == {"condition": True, "path": False}

        await page.close()
        another = await (await chromium.new_context(viewport=SMALL)).new_page()
        await another.goto(f"http://{address}/twin/?fixedDpr=0.25")
        await until_shown(another, "/overlays/path", shown=True)
        await until_shown(another, "/overlays/condition/map", shown=False)


async def test_the_cameras_picture_is_fetched_only_while_it_is_shown(
    chromium: Browser, host: TwinHost, serve: Serve
) -> None:
    host.publish(TwinState(measured=HOME))
    asked: list[str] = []
    picture = cv2.imencode(".jpg", np.full((24, 32), 90, np.uint8))[1].tobytes()

    async def answer(route: Route) -> None:
        asked.append(route.request.url)
        await route.fulfill(body=picture, content_type="image/jpeg")

    async with serve(host) as address:
        page = await chromium.new_page(viewport=SMALL)
        await page.route("**/camera.jpg", answer)
        await page.goto(f"http://{address}/twin/?fixedDpr=0.25")
        await until_shown(page, "/overlays/path", shown=True)
        await until_shown(page, PICTURE, shown=False)
        assert asked == []
        await page.locator("[data-layer=camera]").dispatch_event("click")

        async def is_laid_in() -> bool:
            size = "name => window.__viserSceneTree.getState()[name].message.props._data.length"
            return bool(await page.evaluate(size, PICTURE) == len(picture))

        await eventually(is_laid_in, within_s=15)
        assert asked


def watch_bytes(page: Page) -> Callable[[], Awaitable[int]]:
    """Counts what the page downloads, packed as it comes over the wire."""
    bodies: list[Request] = []
    frames: list[int] = []
    page.on("requestfinished", lambda request: bodies.append(request))  # noqa: PLW0108 - it is marked
    page.on("websocket", lambda ws: ws.on("framereceived", lambda raw: frames.append(len(raw))))

    async def total() -> int:
        sizes = [await request.sizes() for request in bodies if request.url.startswith("http")]
        return sum(frames) + sum(s["responseBodySize"] + s["responseHeadersSize"] for s in sizes)

    return total


async def until_shown(page: Page, node: str, *, shown: bool) -> None:
    """Waits until a node is there and shown, or hidden."""
    effective = "name => window.__viserSceneTree?.getState()[name]?.effectiveVisibility"

    async def is_so() -> bool:
        return bool(await page.evaluate(effective, node) is shown)

    await eventually(is_so, within_s=20)


HIDDEN_WORDS = """() => Object.values(window.__viserSceneTree.getState())
  .filter((node) => node?.message?.type === "LabelMessage" && node.overrideVisibility === false)
  .map((node) => node.message.name)"""


async def test_words_make_room_for_those_of_the_layer_chosen_last(
    chromium: Browser, host: TwinHost, serve: Serve
) -> None:
    host.publish(TwinState(measured=HOME))
    async with serve(host) as address:
        page = await open_twin(chromium, address)
        await page.wait_for_selector("html[data-twin=live]", state="attached", timeout=30_000)
        # They stand about the same square, and the screen is far too small for both.
        size = "/overlays/box/size"
        await page.evaluate("() => document.querySelector('#twin-bar button').click()")

        async def size_becomes(*, hidden: bool) -> None:
            async def is_so() -> bool:
                return (size in await page.evaluate(HIDDEN_WORDS)) is hidden

            await eventually(is_so, within_s=30)

        for layers, hidden in ((("box", "sag"), True), (("sag", "box"), False)):
            for layer in layers:
                switch = page.locator(f"[data-layer={layer}]")
                await switch.uncheck()
                await switch.check()
            await size_becomes(hidden=hidden)
