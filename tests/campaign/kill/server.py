"""``plugpilot serve`` in a garage of the campaign: all its own but the drivers.

``python -m tests.campaign.kill.server SOCKET`` and the options of ``plugpilot serve``.
"""

from __future__ import annotations

import sys

from server import composition
from server.cli import main
from tests.campaign.kill.far_drivers import far_devices

if __name__ == "__main__":
    path = sys.argv.pop(1)
    composition.make_devices = lambda _request: far_devices(path)
    main()
