"""Say in one sentence when this Python is too old or cannot make an environment."""

import sys

if sys.version_info < (3, 11):  # noqa: UP036 - this file is for those that are older
    sys.exit(
        f"PlugPilot needs Python 3.11 or newer, but {sys.executable} is "
        f"{sys.version_info[0]}.{sys.version_info[1]}. "
        "Name another one, as in: make run PYTHON=python3.12"
    )
try:
    import ensurepip  # noqa: F401 - Debian leaves it out of its python3 package
except ImportError:
    sys.exit("This Python cannot make environments. On Debian: sudo apt-get install python3-venv")
