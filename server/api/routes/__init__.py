"""The REST operations and the WebSocket, one module per subject."""
