"""What an event loop says of sockets whose other side has gone."""

from __future__ import annotations

import asyncio
import errno

import pytest
import viser

from twin.scene.vanished import forgive_the_vanished


@pytest.mark.parametrize(("number", "told"), [(errno.ENOTCONN, False), (errno.ENOSPC, True)])
async def test_a_client_that_vanishes_is_no_error_of_ours(
    number: int, caplog: pytest.LogCaptureFixture, *, told: bool
) -> None:
    loop = asyncio.get_running_loop()
    forgive_the_vanished(loop)
    loop.call_exception_handler({"message": "in a callback", "exception": OSError(number, "gone")})
    assert bool(caplog.records) is told


def test_viser_on_its_own_loop_is_forgiving_too(
    server: viser.ViserServer, caplog: pytest.LogCaptureFixture
) -> None:
    loop = server.get_event_loop()
    for number in (errno.ENOTCONN, errno.ENOSPC):
        loop.call_exception_handler({"message": "", "exception": OSError(number, "gone")})
    errors = [record.exc_info[1] for record in caplog.records if record.exc_info]
    assert [error.errno for error in errors if isinstance(error, OSError)] == [errno.ENOSPC]
