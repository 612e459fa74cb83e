"""Webhooks: who is told what happens."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path, Response

from server.api.dependencies import ServicesDep
from server.api.etags import (
    ETAG_HEADER,
    VERSIONED,
    IfMatch,
    etag_of,
    refuse_mismatch,
    require_match,
)
from server.api.pagination import Cursor, Limit, id_in, split_page
from server.api.problems import problem_responses
from server.schema.webhooks import (
    Delivery,
    DeliveryPage,
    Webhook,
    WebhookPage,
    WebhookSettings,
    WebhookWithSecret,
)
from server.storage.webhooks import StoredWebhook

router = APIRouter(prefix="/webhooks", tags=["webhooks"])

WebhookId = Annotated[str, Path(max_length=64, description="As in the list of webhooks")]


@router.get(
    "", operation_id="listWebhooks", summary="List webhooks", responses=problem_responses(400)
)
async def list_webhooks(
    services: ServicesDep, cursor: Cursor = None, limit: Limit = 20
) -> WebhookPage:
    """Webhooks, oldest first. Their secrets are not shown."""
    found = await services.webhooks.all(after=id_in(cursor), limit=limit + 1)
    page, last = split_page(found, limit)
    return WebhookPage(
        items=[webhook.shown for webhook in page], next_cursor=last.id if last else None
    )


@router.post(
    "",
    status_code=201,
    operation_id="createWebhook",
    summary="Make a webhook",
    responses={
        201: {
            "headers": ETAG_HEADER
            | {"Location": {"description": "Its address", "schema": {"type": "string"}}}
        },
        **problem_responses(409, 422, 503),
    },
)
async def create_webhook(
    settings: WebhookSettings, response: Response, services: ServicesDep
) -> WebhookWithSecret:
    """Each event is sent as POST, signed as Standard Webhooks 1.0 describe.

    The answer holds the secret; it is shown this once. What is not answered with 2xx within 10 s
    is tried again after 5 s, 5 min, 30 min, 2 h and 5 h; an answer 410 switches the webhook off.
    """
    webhook = await services.webhooks.add(settings)
    response.headers["Location"] = f"/api/v1/webhooks/{webhook.id}"
    response.headers["ETag"] = etag_of(webhook.shown)
    return _with_secret(webhook)


@router.get(
    "/{webhook_id}",
    operation_id="getWebhook",
    summary="Read a webhook",
    responses={**VERSIONED, **problem_responses(404)},
)
async def get_webhook(webhook_id: WebhookId, response: Response, services: ServicesDep) -> Webhook:
    """One webhook, without its secret."""
    webhook = (await services.webhooks.get(webhook_id)).shown
    response.headers["ETag"] = etag_of(webhook)
    return webhook


@router.put(
    "/{webhook_id}",
    operation_id="putWebhook",
    summary="Change a webhook",
    responses={**VERSIONED, **problem_responses(404, 412, 422, 428, 503)},
)
async def put_webhook(
    webhook_id: WebhookId,
    settings: WebhookSettings,
    response: Response,
    services: ServicesDep,
    if_match: IfMatch = None,
) -> Webhook:
    """What waits goes to the new target; switched off, it is dropped. The secret stays."""
    changed = await services.webhooks.change(
        webhook_id, settings, lambda known: require_match(if_match, known.shown)
    )
    response.headers["ETag"] = etag_of(changed.shown)
    return changed.shown


@router.delete(
    "/{webhook_id}",
    status_code=204,
    response_class=Response,
    operation_id="deleteWebhook",
    summary="Delete a webhook",
    responses=problem_responses(404, 412, 503),
)
async def delete_webhook(
    webhook_id: WebhookId, services: ServicesDep, if_match: IfMatch = None
) -> None:
    """Nothing more is sent; its deliveries are forgotten."""
    await services.webhooks.delete(webhook_id, lambda known: refuse_mismatch(if_match, known.shown))


@router.post(
    "/{webhook_id}/ping",
    status_code=202,
    operation_id="pingWebhook",
    summary="Try a webhook out",
    responses=problem_responses(404, 503),
)
async def ping_webhook(webhook_id: WebhookId, services: ServicesDep) -> Delivery:
    """Send an event of the type ping. The list of deliveries shows what came of it."""
    return (await services.webhooks.ping(webhook_id)).shown


@router.post(
    "/{webhook_id}/rotate-secret",
    operation_id="rotateWebhookSecret",
    summary="Give a webhook another secret",
    responses=problem_responses(404, 503),
)
async def rotate_secret(webhook_id: WebhookId, services: ServicesDep) -> WebhookWithSecret:
    """The old one signs nothing any more, from the next attempt on."""
    return _with_secret(await services.webhooks.rotate_secret(webhook_id))


@router.get(
    "/{webhook_id}/deliveries",
    operation_id="listWebhookDeliveries",
    summary="List deliveries",
    responses=problem_responses(400, 404),
)
async def list_deliveries(
    webhook_id: WebhookId, services: ServicesDep, cursor: Cursor = None, limit: Limit = 20
) -> DeliveryPage:
    """What waits and what came of the rest, newest first."""
    found = await services.webhooks.log(webhook_id, before=id_in(cursor), limit=limit + 1)
    page, last = split_page(found, limit)
    return DeliveryPage(
        items=[delivery.shown for delivery in page], next_cursor=last.id if last else None
    )


def _with_secret(webhook: StoredWebhook) -> WebhookWithSecret:
    return WebhookWithSecret(**webhook.shown.model_dump(), secret=webhook.secret)
