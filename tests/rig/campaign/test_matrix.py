"""Every fault in every situation, and the table of what became of it."""

from __future__ import annotations

import pytest

from tests.rig.build import Programs
from tests.rig.matrix.cell import Row, run_cell
from tests.rig.matrix.faults import FAULTS, FaultCase
from tests.rig.matrix.situations import SITUATIONS, Situation


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault.name)
@pytest.mark.parametrize("situation", SITUATIONS, ids=lambda situation: situation.name)
async def test_every_fault_ends_safely_and_there_is_a_way_back(
    programs: Programs, table: list[Row], situation: Situation, fault: FaultCase
) -> None:
    table.append(await run_cell(programs, situation, fault))
