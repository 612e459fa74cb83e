from __future__ import annotations

import pytest

from tests.rig.build import Programs, build_programs, missing_packages


@pytest.fixture(scope="session")
def programs() -> Programs:
    """Firmware and simulator, built from the sources."""
    missing = missing_packages()
    if missing:
        pytest.skip(f"the rig needs packages of the system: {' '.join(missing)}")
    return build_programs()
