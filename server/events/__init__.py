"""What happens, as events: for webhooks and the event stream."""

from server.events.log import EventLog

__all__ = ["EventLog"]
