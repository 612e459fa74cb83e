"""Ten thousand random segments on the real firmware's own assembler, step by step.

The same comparison over 100 000 segments runs on the core compiled for this computer, in
tests/drivers/arduino_firmware.
"""

from __future__ import annotations

import pytest

from tests.rig.build import Programs
from tests.rig.chains import compare_random_groups
from tests.rig.raw import raw_board
from tests.rig.rig import running_rig

PARTS = 8
GROUPS_OF_PART = 80
"""Of sixteen segments, three of them rests."""


@pytest.mark.parametrize("part", range(PARTS))
async def test_every_step_of_ten_thousand_segments(programs: Programs, part: int) -> None:
    async with running_rig(programs) as rig, raw_board(rig) as board:
        steps = await compare_random_groups(board, GROUPS_OF_PART, seed=100 + part)
        assert (await rig.control.statistics()).late_ticks == 0
    print(f"\n{steps} steps of {16 * GROUPS_OF_PART} segments, each in its tick")
    assert steps > 80_000
