"""What runs here: this software, what it is built on, the board's firmware and its protocol."""

from __future__ import annotations

import platform
from importlib.metadata import PackageNotFoundError, version

from drivers.arduino.protocol.messages import PROTOCOL_HASH
from drivers.robot import RobotIdentity
from server.schema.versions import LibraryVersion, Versions
from server.technician.changes import releases
from server.version import VERSION

LIBRARIES = (
    "fastapi",
    "numpy",
    "opencv-python-headless",
    "pydantic",
    "pyserial",
    "sqlalchemy",
    "uvicorn",
    "viser",
    "websockets",
    "zxing-cpp",
)


def versions(identity: RobotIdentity | None) -> Versions:
    """All versions.

    Args:
        identity: How the motion board has introduced itself; None before it has.
    """
    return Versions(
        software=VERSION,
        python=platform.python_version(),
        system=f"{platform.system()} {platform.release()} {platform.machine()}",
        libraries=[
            LibraryVersion(name=name, version=found)
            for name in LIBRARIES
            if (found := _installed(name)) is not None
        ],
        board=identity.name if identity else None,
        firmware=identity.firmware if identity else None,
        protocol_hash=f"{PROTOCOL_HASH:08x}",
        releases=releases(),
    )


def _installed(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None
