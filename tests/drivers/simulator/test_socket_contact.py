from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.simulator.parameters import ContactParameters
from drivers.simulator.socket_contact import FREE, Contact, Place, SocketContact
from twin.kinematics import PlatformPosition

NUMBERS = ContactParameters()
V = PlatformPosition(650.0, 335.0)


def go(
    socket: SocketContact, depths: list[float], lateral: float = 0.0, contact: Contact = FREE
) -> list[Contact]:
    path = []
    for depth in depths:
        contact = socket.moved(contact, depth, lateral, V)
        path.append(contact)
    return path


def ramp(start: float, end: float, step: float = 0.01) -> list[float]:
    count = round(abs(end - start) / step)
    return [start + (end - start) * i / count for i in range(count + 1)]


def test_insertion_force_over_depth() -> None:
    socket = SocketContact(NUMBERS, 70.0)
    path = go(socket, ramp(-2.0, 40.0))
    by_depth = {round(c.depth_mm, 2): c.force_n for c in path}
    assert by_depth[-1.0] == 0.0
    assert by_depth[2.0] == pytest.approx(6.3, abs=0.2)  # the chamfer
    assert by_depth[10.0] < 5.0
    assert by_depth[17.0] < 6.0
    assert by_depth[30.0] == pytest.approx(35.0, abs=0.5)
    assert by_depth[37.0] == pytest.approx(70.0, abs=0.01)
    assert by_depth[40.0] == pytest.approx(42.0, abs=0.5)
    peak = max(path, key=lambda c: c.force_n)
    assert 36.0 <= peak.depth_mm <= 38.0
    assert path[-1].place is Place.IN_SOCKET


def test_withdrawal_first_relaxes_then_resists_and_then_falls() -> None:
    socket = SocketContact(NUMBERS, 70.0)
    seated = go(socket, ramp(-2.0, 40.0))[-1]
    path = go(socket, ramp(40.0, -1.0), contact=seated)
    by_depth = {round(c.depth_mm, 2): c.force_n for c in path}
    assert by_depth[40.0] > 0
    assert by_depth[39.9] == pytest.approx(seated.force_n - 0.1 * 200.0, abs=0.5)
    assert by_depth[39.0] == pytest.approx(-66.5, abs=0.1)
    assert by_depth[30.0] == pytest.approx(-21.0, abs=0.1)
    assert by_depth[10.0] > -6.0
    assert path[-1].force_n == 0.0
    assert path[-1].place is Place.FREE


def test_the_end_stop_is_stiff() -> None:
    socket = SocketContact(NUMBERS, 70.0)
    path = go(socket, ramp(-1.0, 40.6))
    assert path[-1].force_n - path[-11].force_n == pytest.approx(0.1 * 400.0, abs=2.0)


def test_a_small_lateral_error_goes_in_with_more_friction() -> None:
    socket = SocketContact(NUMBERS, 70.0)
    straight = go(socket, ramp(-1.0, 40.0))
    beside = go(socket, ramp(-1.0, 40.0), lateral=1.0)
    assert beside[-1].place is Place.IN_SOCKET
    assert max(c.force_n for c in beside) - max(c.force_n for c in straight) == pytest.approx(
        NUMBERS.misalignment_friction_n_mm
    )
    assert beside[-1].entry_lateral_mm == 1.0


@pytest.mark.parametrize(
    ("lateral", "place"), [(1.5, Place.IN_SOCKET), (1.51, Place.AGAINST_PANEL)]
)
def test_the_chamfer_takes_up_its_compliance_and_no_more(lateral: float, place: Place) -> None:
    socket = SocketContact(NUMBERS, 70.0)
    assert go(socket, [-0.5, 0.1, 0.2], lateral)[-1].place is place


def test_a_plug_beside_the_opening_meets_a_spring_and_can_be_drawn_back() -> None:
    socket = SocketContact(NUMBERS, 70.0)
    jammed = go(socket, ramp(-1.0, 0.5), lateral=3.0)[-1]
    assert jammed.force_n == pytest.approx(75.0)
    # sliding sideways over the opening does not pull it in
    assert socket.moved(jammed, 0.5, 0.0, V).place is Place.AGAINST_PANEL
    free = go(socket, ramp(0.5, -0.5), lateral=3.0, contact=jammed)[-1]
    assert (free.place, free.force_n) == (Place.FREE, 0.0)
    assert go(socket, [0.1], contact=free)[-1].place is Place.IN_SOCKET


def test_the_lock_holds_like_a_spring_and_lets_push_in_further() -> None:
    socket = SocketContact(NUMBERS, 70.0)
    seated = go(socket, ramp(-1.0, 39.5))[-1]
    locked = seated._replace(locked_at_mm=39.5)
    pulled = go(socket, ramp(39.5, 39.0), contact=locked)[-1]
    unlocked = go(socket, ramp(39.5, 39.0), contact=seated)[-1]
    assert pulled.force_n - unlocked.force_n == pytest.approx(-75.0)
    deeper = go(socket, ramp(39.5, 39.9), contact=locked)[-1]
    assert deeper.force_n == go(socket, ramp(39.5, 39.9), contact=seated)[-1].force_n


@given(
    st.lists(st.floats(-1.0, 40.4), min_size=1, max_size=60),
    st.floats(0.0, 1.5),
    st.floats(10.0, 90.0),
)
def test_friction_stays_between_its_limits_and_does_no_work_for_nothing(
    depths: list[float], lateral: float, peak: float
) -> None:
    socket = SocketContact(NUMBERS, peak)
    contact = socket.moved(FREE, -0.5, lateral, V)
    for depth in depths:
        contact = socket.moved(contact, depth, lateral, V)
        if contact.place is Place.FREE:
            assert contact.force_n == 0.0
            continue
        assert contact.force_n <= socket.insertion_limit_n(depth, lateral) + 1e-9
        assert contact.force_n >= -socket.withdrawal_limit_n(depth, lateral) - 1e-9
    # going round in a circle costs energy
    work = 0.0
    for depth in [*ramp(contact.depth_mm, 40.0, 0.05), *ramp(40.0, -0.5, 0.05)]:
        moved = socket.moved(contact, depth, lateral, V)
        work += 0.5 * (moved.force_n + contact.force_n) * (depth - contact.depth_mm)
        contact = moved
    assert work > 0
