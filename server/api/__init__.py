"""The public API: REST, WebSocket, pages and the twin on one port."""
