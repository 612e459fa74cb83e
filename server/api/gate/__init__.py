"""The gate: every request and every message passes it, and what it does not know it refuses."""

from server.api.gate.caller import caller_of
from server.api.gate.gate import Gate
from server.api.gate.headers import SecurityHeaders
from server.api.gate.messages import admit_message
from server.api.gate.routes import RouteTable

__all__ = ["Gate", "RouteTable", "SecurityHeaders", "admit_message", "caller_of"]
