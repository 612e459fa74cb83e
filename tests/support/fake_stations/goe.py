"""A go-e charger with its local API v2."""

from __future__ import annotations

from typing import Any

from fastapi import FastAPI, Response
from fastapi.responses import JSONResponse


class FakeGoe:
    """The charger and the car."""

    def __init__(self) -> None:
        self.car = 1
        self.frc = 0
        self.amp = 32
        self.fields: dict[str, Any] = {}
        self.uptime_ms = 1_000_000
        self.clock_stands = False
        self.refuses = False
        self.app = self._make_app()

    def plug(self) -> None:
        self.car = 2 if self.frc != 1 else 3

    def unplug(self) -> None:
        self.car = 1

    def status(self) -> dict[str, Any]:
        self.uptime_ms += 0 if self.clock_stands else 7
        amps = 15.9 if self.car == 2 else 0
        nrg = [
            231,
            230,
            232,
            1,
            amps,
            amps,
            0,
            amps * 231,
            amps * 230,
            0,
            0,
            amps * 461,
            99,
            99,
            0,
            0,
        ]
        return {
            "car": self.car,
            "alw": self.frc != 1,
            "frc": self.frc,
            "nrg": nrg,
            "wh": 812.5,
            "cus": 1 if self.car == 1 else 3,
            "err": 0,
            "rbt": self.uptime_ms,
            **self.fields,
        }

    def force(self, frc: int) -> None:
        self.frc = frc
        if self.car != 1:
            self.plug()

    def _make_app(self) -> FastAPI:
        app = FastAPI()

        @app.get("/api/status")
        async def status(filter: str) -> dict[str, Any]:  # noqa: A002 - the name in the API
            everything = self.status()
            return {key: everything[key] for key in filter.split(",")}

        @app.get("/api/set")
        async def set_(frc: int | None = None, amp: int | None = None) -> Response:
            name = "amp" if frc is None else "frc"
            if self.refuses:
                return JSONResponse({name: "read-only"})
            if frc is not None:
                self.force(frc)
            self.amp = amp if amp is not None else self.amp
            return JSONResponse({name: True})

        return app
