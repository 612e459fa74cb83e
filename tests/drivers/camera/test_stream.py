"""A network camera on a real socket."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import cv2
import numpy as np
import pytest
from pydantic import SecretStr, ValidationError

from drivers.camera.errors import CameraMissingError
from drivers.camera.settings import StreamSettings
from drivers.camera.stream import StreamSource

PICTURES, FRAMES_PER_S = 40, 100.0


class MotionJpeg(BaseHTTPRequestHandler):
    """Sends a fixed number of pictures, as network cameras send them, and hangs up."""

    def do_GET(self) -> None:
        self.send_response(200)
        self.send_header("Content-Type", "multipart/x-mixed-replace; boundary=frame")
        self.end_headers()
        for number in range(PICTURES):
            time.sleep(1 / FRAMES_PER_S)
            _, jpeg = cv2.imencode(".jpg", np.full((48, 64, 3), 4 * number, dtype=np.uint8))
            head = f"--frame\r\nContent-Type: image/jpeg\r\nContent-Length: {jpeg.size}\r\n\r\n"
            self.wfile.write(head.encode() + jpeg.tobytes() + b"\r\n")

    def log_message(self, *_: object) -> None:
        """Nothing is written to the terminal."""


@pytest.fixture
def address() -> Iterator[str]:
    server = ThreadingHTTPServer(("127.0.0.1", 0), MotionJpeg)
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    yield f"http://127.0.0.1:{server.server_port}/stream.mjpg"
    server.shutdown()
    thread.join()
    server.server_close()


def test_pictures_come_over_the_network_and_the_end_is_noticed(address: str) -> None:
    source = StreamSource(StreamSettings(url=address, latency_s=0.25, frames_per_s=FRAMES_PER_S))
    source.open()
    first = source.read()
    assert first.image.shape == (48, 64)
    assert time.monotonic() - first.captured_s == pytest.approx(0.25, abs=0.1)
    assert source.skip() >= 1
    with pytest.raises(CameraMissingError, match="has ended"):
        read_all(source)
    source.close()
    source.close()


def read_all(source: StreamSource) -> None:
    for _ in range(PICTURES):
        source.read()


def test_nobody_there(address: str) -> None:
    host, port = address.split("/")[2].split(":")
    closed = StreamSource(StreamSettings(url=f"http://{host}:1/{port}"))
    with pytest.raises(CameraMissingError, match=r"127\.0\.0\.1 does not answer"):
        closed.open()
    closed.close()


def test_an_address_is_needed() -> None:
    with pytest.raises(CameraMissingError, match=r"set camera\.link\.stream\.url"):
        StreamSource(StreamSettings()).open()


def test_who_logs_in_stands_beside_the_address_and_is_shown_nowhere() -> None:
    with pytest.raises(ValidationError, match="into user and password"):
        StreamSettings(url="rtsp://admin:secret@camera.local/stream")
    settings = StreamSettings(
        url="rtsp://camera.local:8554/s?x=1", user="ad min", password=SecretStr("p@ss/word")
    )
    assert settings.address == "rtsp://ad%20min:p%40ss%2Fword@camera.local:8554/s?x=1"
    assert StreamSource(settings).name == "Camera at camera.local"
    assert "word@" not in f"{settings!r} {settings.model_dump_json()}"
    assert StreamSettings(url="http://camera.local/").address == "http://camera.local/"
