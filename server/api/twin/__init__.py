"""The page with the live 3D picture, and the WebSocket that feeds it."""

from server.api.twin.bridge import AllowedClientMessages, viewer_messages
from server.api.twin.router import twin_router

__all__ = ["AllowedClientMessages", "twin_router", "viewer_messages"]
