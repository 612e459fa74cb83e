"""Passkeys with Chromium's own virtual authenticator."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.chromium import PHONE
from tests.support.process import INVITATION, ServerProcess, serving

LOADED_MS = 30_000
"""A busy machine may take its time."""

AUTHENTICATOR = {
    "protocol": "ctap2",
    "transport": "internal",
    "hasResidentKey": True,
    "hasUserVerification": True,
    "isUserVerified": True,
    "automaticPresenceSimulation": True,
}


@pytest.fixture
def server() -> Iterator[ServerProcess]:
    with serving("--speed", "10") as running:
        yield running


@pytest.fixture
def owner(browser: Browser, server: ServerProcess) -> Iterator[Page]:
    """The owner's page on a phone with an authenticator. Passkeys need a name, not an address."""
    assert server.process.stdout is not None
    address = server.process.stdout.readline().removeprefix(INVITATION).strip()
    context = browser.new_context(viewport={"width": PHONE["width"], "height": PHONE["height"]})
    page = context.new_page()
    session = context.new_cdp_session(page)
    session.send("WebAuthn.enable")
    session.send("WebAuthn.addVirtualAuthenticator", {"options": AUTHENTICATOR})
    page.goto(address.replace("127.0.0.1", "localhost"))
    expect(page.get_by_role("button", name="Charge", exact=True)).to_be_visible(timeout=LOADED_MS)
    yield page
    context.close()


def _add_passkey(page: Page) -> None:
    page.get_by_role("button", name="People and devices").click()
    page.get_by_role("button", name="Me", exact=True).click()
    page.get_by_role("button", name="Add a passkey").click()
    expect(page.get_by_role("dialog").get_by_text("Chrome on Linux")).to_be_visible(
        timeout=LOADED_MS
    )


def _sign_out(page: Page) -> None:
    page.get_by_role("button", name="Sign this device out").click()
    page.get_by_role("button", name="Really remove?").click()
    expect(page.get_by_role("heading", level=1)).to_have_text(
        "This device is not paired yet", timeout=LOADED_MS
    )


def _cookies(page: Page) -> list[str]:
    return [str(cookie.get("value")) for cookie in page.context.cookies()]


def test_a_passkey_lets_its_person_in_again(owner: Page) -> None:
    _add_passkey(owner)
    before = _cookies(owner)
    _sign_out(owner)
    assert _cookies(owner) == []

    owner.get_by_role("button", name="Use my passkey").click()

    expect(owner.get_by_role("button", name="Charge", exact=True)).to_be_visible(timeout=LOADED_MS)
    assert _cookies(owner) != before
    session = owner.evaluate("fetch('/api/v1/access/session').then(r => r.json())")
    assert (session["person"]["name"], session["person"]["role"]) == ("Owner", "owner")


def test_a_passkey_that_was_removed_lets_nobody_in(owner: Page) -> None:
    _add_passkey(owner)
    owner.get_by_role("dialog").get_by_role("button", name="Remove").click()
    owner.get_by_role("button", name="Really remove?").click()
    expect(owner.get_by_role("dialog").get_by_text("Chrome on Linux")).to_have_count(
        0, timeout=LOADED_MS
    )
    _sign_out(owner)

    owner.get_by_role("button", name="Use my passkey").click()

    expect(owner.get_by_role("alert")).to_contain_text(
        "The passkey was not accepted", timeout=LOADED_MS
    )


REPLAY = """async () => {
  const post = (path, body) => fetch('/api/v1/access' + path, {
    method: 'POST', body: JSON.stringify(body), headers: {'Content-Type': 'application/json'},
  });
  const { options } = await (await post('/login/options')).json();
  const publicKey = PublicKeyCredential.parseRequestOptionsFromJSON(options);
  const credential = (await navigator.credentials.get({ publicKey })).toJSON();
  const first = await post('/login', { credential });
  const replayed = await post('/login', { credential });
  const forged = structuredClone(credential);
  forged.response.signature = forged.response.signature.replace(/^..../, 'AAAA');
  return [first.status, replayed.status, (await post('/login', { credential: forged })).status];
}"""


def test_an_answer_is_good_once(owner: Page) -> None:
    _add_passkey(owner)
    assert owner.evaluate(REPLAY) == [200, 403, 403]
