"""Forgets what the fuzzing made, so that growing memory means a leak and not a long list."""

from __future__ import annotations

from tests.support.process import ServerProcess

LISTS = ("access/keys", "access/invitations", "webhooks", "vehicles")


def tidy(server: ServerProcess) -> None:
    """Remove keys, invitations, webhooks and vehicles, but for what cannot be removed now."""
    with server.rest() as owner:
        for path in LISTS:
            while True:
                page = owner.get(path, params={"limit": 100})
                page.raise_for_status()
                items = page.json()["items"]
                removed = [
                    owner.delete(f"{path}/{item['id']}").status_code == 204
                    for item in items
                    if item["id"] != "demo"
                ]
                if not any(removed):
                    break
