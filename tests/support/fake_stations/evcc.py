"""An evcc as version 0.302 behaves, with an OpenEVSE or nothing as its charger."""

from __future__ import annotations

from typing import Any

from fastapi import FastAPI, Response
from fastapi.responses import JSONResponse

from tests.support.fake_stations.openevse import FakeOpenevse


class FakeEvcc:
    """Two load points; the second is ours. tick() is one interval."""

    def __init__(self, charger: FakeOpenevse | None = None) -> None:
        self.charger = charger
        self.mode = "off"
        self.enabled = False
        self.sticky = False
        """It takes the mode off but goes on."""
        self.point: dict[str, Any] = {
            "connected": True,
            "charging": False,
            "chargePower": 0,
            "chargeCurrents": None,
            "sessionEnergy": 0,
        }
        self.modes: list[str] = []
        self.app = self._make_app()

    def tick(self) -> None:
        """Read the charger as it is, then tell it what the mode wants."""
        if self.charger is not None:
            charging = self.charger.charging
            self.point |= {
                "connected": self.charger.connected,
                "charging": charging,
                "chargePower": 7200 if charging else 0,
            }
        self._control()

    def _control(self) -> None:
        self.enabled = self.mode != "off" or self.sticky
        if self.charger is not None:
            state = "active" if self.enabled else "disabled"
            self.charger.override = {"state": state, "auto_release": True}

    def _make_app(self) -> FastAPI:
        app = FastAPI()

        @app.get("/api/state")
        async def state() -> dict[str, Any]:
            other = {"mode": "pv", "enabled": False} | dict(self.point, connected=False)
            ours = {"mode": self.mode, "enabled": self.enabled, **self.point}
            return {"siteTitle": "Home", "interval": 30, "loadpoints": [other, ours]}

        @app.post("/api/loadpoints/{number}/mode/{mode}")
        async def set_mode(number: int, mode: str) -> Response:
            if number != 2:
                return Response("404 page not found", 404, media_type="text/plain")
            if mode not in {"off", "now", "pv", "minpv"}:
                return JSONResponse({"error": f"invalid value: {mode}"}, 400)
            self.mode = mode
            self.modes.append(mode)
            self._control()
            return JSONResponse(mode)

        return app
