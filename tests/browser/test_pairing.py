"""Getting in and getting out, on the real server with the real pages."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from playwright.sync_api import Browser, BrowserContext, Page, expect

from tests.browser.chromium import DESKTOP, PHONE
from tests.support.process import INVITATION, ServerProcess, serving

ONE_TIME = "#pair="


@pytest.fixture
def server() -> Iterator[ServerProcess]:
    """A robot that nobody owns yet."""
    with serving("--speed", "10", "--seed", "3") as running:
        yield running


@contextmanager
def opened(browser: Browser, address: str, *, wide: bool = False) -> Iterator[Page]:
    """A browser that has never been here opens an address; no script may fail."""
    size = DESKTOP if wide else PHONE
    context = browser.new_context(viewport={"width": size["width"], "height": size["height"]})
    page = context.new_page()
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(address)
    yield page
    context.close()
    assert errors == []


def expect_home(page: Page) -> None:
    expect(page.get_by_role("button", name="Charge", exact=True)).to_be_visible(timeout=30_000)


def expect_door(page: Page) -> None:
    expect(page.get_by_role("heading", level=1)).to_have_text(
        "This device is not paired yet", timeout=30_000
    )


def cookies(context: BrowserContext) -> list[tuple[str, bool, str]]:
    return [
        (cookie["name"].split("-")[0], cookie["httpOnly"], cookie["sameSite"])
        for cookie in context.cookies()
    ]


def invite(owner: Page, name: str, role: str) -> str:
    """Has the owner invite somebody; gives the address that the QR code holds."""
    owner.get_by_role("button", name="People and devices").click()
    owner.get_by_role("button", name="Invite somebody").click()
    owner.get_by_label("Name").fill(name)
    owner.get_by_label("What they may do").select_option(role)
    owner.get_by_role("button", name="Make the invitation").click()
    code = owner.locator("img.qr")
    expect(code).to_be_visible()
    address = code.get_attribute("alt")
    assert address is not None
    owner.get_by_role("dialog").get_by_role("button", name="Done").last.click()
    return address


def test_the_printed_address_makes_the_first_browser_the_owners_and_works_once(
    browser: Browser, server: ServerProcess
) -> None:
    assert server.process.stdout is not None
    address = server.process.stdout.readline().removeprefix(INVITATION).strip()
    with opened(browser, server.url) as stranger:
        expect_door(stranger)
        assert cookies(stranger.context) == []
    with opened(browser, address) as owner:
        expect_home(owner)
        assert ONE_TIME not in owner.url
        assert cookies(owner.context) == [("plugpilot", True, "Strict")]
        owner.reload()
        expect_home(owner)
        with opened(browser, address) as second:
            expect_door(second)
            expect(second.get_by_role("alert")).to_contain_text("This invitation is not valid")
        # in the same browser: what it is already is not given up without a question
        owner.goto(address)
        expect(owner.get_by_role("dialog")).to_contain_text("already paired as Owner")


def test_the_owner_invites_and_removes(browser: Browser, server: ServerProcess) -> None:
    assert server.process.stdout is not None
    printed = server.process.stdout.readline().removeprefix(INVITATION).strip()
    with opened(browser, printed, wide=True) as owner:
        expect_home(owner)
        address = invite(owner, "Grandma", "viewer")
        with opened(browser, server.url) as grandma:
            expect_door(grandma)
            grandma.get_by_label("Invitation address").fill(address)
            grandma.get_by_role("button", name="Pair this device").click()
            expect(grandma.get_by_text("You can watch")).to_be_visible(timeout=30_000)
            assert not grandma.get_by_role("button", name="Charge", exact=True).is_visible()
            refused = grandma.evaluate(
                "fetch('/api/v1/jobs', {method: 'POST', body: '{\"type\": \"charge\"}',"
                " headers: {'Content-Type': 'application/json'}}).then(r => r.status)"
            )
            assert refused == 403

            owner.get_by_role("button", name="People and devices").click()
            person = owner.get_by_role("dialog").locator(".entries > li", has_text="Grandma")
            expect(person).to_contain_text("Chrome on Linux")
            person.get_by_role("button", name="Remove").first.click()
            person.get_by_role("button", name="Really remove?").click()

            expect_door(grandma)
            expect(person).to_have_count(0)
        owner.get_by_role("button", name="Activity").click()
        expect(owner.locator(".trail")).to_contain_text("New device paired")
        refusal = "Refused: Begin a charge or another job (forbidden)"
        expect(owner.locator(".trail")).to_contain_text(refusal)


def test_a_key_is_shown_once(browser: Browser, server: ServerProcess) -> None:
    with opened(browser, server.url) as owner:
        server.let_in(owner.context)
        owner.reload()
        expect_home(owner)
        owner.get_by_role("button", name="People and devices").click()
        owner.get_by_role("button", name="Keys").click()
        owner.get_by_label("What is it for?").fill("The energy manager")
        owner.get_by_role("button", name="Make a key").click()
        key = owner.locator(".secret").inner_text()
        assert key.startswith("plugpilot_")
        owner.get_by_role("button", name="People", exact=True).click()
        owner.get_by_role("button", name="Keys").click()
        expect(owner.get_by_text("The energy manager")).to_be_visible()
        assert key not in owner.content()
        assert key[-4:] in owner.content()


def test_every_page_can_be_used_at_both_sizes(browser: Browser, server: ServerProcess) -> None:
    for wide in (False, True):
        with opened(browser, server.url, wide=wide) as page:
            expect_door(page)
            width = (DESKTOP if wide else PHONE)["width"]
            assert page.evaluate("document.documentElement.scrollWidth") <= width
            server.let_in(page.context)
            page.reload()
            expect_home(page)
            assert page.evaluate("document.documentElement.scrollWidth") <= width
            page.get_by_role("button", name="People and devices").click()
            for tab in ("People", "Keys", "Activity", "Me"):
                page.get_by_role("button", name=tab, exact=True).click()
                dialog = page.get_by_role("dialog")
                assert dialog.evaluate("d => d.scrollWidth <= d.clientWidth"), tab
