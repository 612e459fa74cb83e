"""Say in one sentence when this Python is too old or cannot make an environment."""

import sys

if sys.version_info < (3, 11):
    sys.exit(
        "PlugPilot needs Python 3.11 or newer, but %s is %d.%d. "
        "Name another one, as in: make run PYTHON=python3.12" % ((sys.executable,) + sys.version_info[:2])
    )
try:
    import ensurepip  # noqa: F401 - Debian leaves it out of its python3 package
except ImportError:
    sys.exit("This Python cannot make environments. On Debian: sudo apt-get install python3-venv")
