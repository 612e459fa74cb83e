"""A few cells of the table of faults and situations; `make rig` tries all of them."""

from __future__ import annotations

import pytest

from tests.rig.build import Programs
from tests.rig.matrix.cell import run_cell
from tests.rig.matrix.faults import FAULTS
from tests.rig.matrix.situations import SITUATIONS


@pytest.mark.parametrize(
    ("situation", "fault", "code"),
    [("homing", "USB unplugged", "link lost"), ("inserting", "emergency stop", "emergency_stop")],
)
async def test_a_fault_ends_safely_and_there_is_a_way_back(
    programs: Programs, situation: str, fault: str, code: str
) -> None:
    row = await run_cell(
        programs,
        next(one for one in SITUATIONS if one.name == situation),
        next(one for one in FAULTS if one.name == fault),
    )
    assert code in row.codes
    assert row.outcome != "done"
    assert row.still_after_s is not None
    assert row.still_after_s < 1.0
