"""Errors of webhooks.

WebhookError
├── WebhookNotFoundError   no such webhook
├── TooManyWebhooksError   there are as many as the configuration allows
└── ForbiddenTargetError   the target may not be reached
"""

from __future__ import annotations

from server.errors import PlugPilotError


class WebhookError(PlugPilotError):
    """A webhook cannot be what it should."""

    code = "webhook"
    title = "The webhook cannot be used"
    status = 409


class WebhookNotFoundError(WebhookError):
    """There is no such webhook."""

    code = "webhook_not_found"
    title = "There is no such webhook"
    status = 404
    remedy = "Look at the list of webhooks for the right id."


class TooManyWebhooksError(WebhookError):
    """There are as many as the configuration allows."""

    code = "too_many_webhooks"
    title = "There are too many webhooks"
    remedy = "Delete one, or raise webhooks.max_webhooks in the configuration."


class ForbiddenTargetError(WebhookError):
    """The target may not be reached."""

    code = "target_forbidden"
    title = "This target may not be reached"
    status = 422
    remedy = "Use a public HTTPS address, or add the network to webhooks.allowed_networks."
