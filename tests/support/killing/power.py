"""What a power cut does to a garage."""

from __future__ import annotations

from drivers.robot import BoardState
from drivers.simulator.board import SimulatedBoard
from drivers.simulator.garage import SimulatedGarage

CREEP_MM = 0.5
"""How far the joints stand from what the board remembers: standard deviation."""


def cut_power(garage: SimulatedGarage, now_s: float) -> None:
    """The whole house is dark for a moment: board and station start anew.

    The motors stand where they stood, a little off from what the board remembers; the station has
    forgotten its hold and gives power to whoever is plugged in, as stations do.
    """
    world, robot = garage.world, garage.robot
    robot._board.state = BoardState.IDLE  # whatever it was about to do, it does no more
    state = world.advance(now_s)
    world.drive_to(state.motors, now_s)
    for joint, motor_mm in enumerate(state.motors):
        creep_mm = float(world.streams.power_up.normal(0.0, CREEP_MM))
        world.renumber(joint, motor_mm + creep_mm, now_s)
    if robot._board_task is not None:
        robot._board_task.cancel()
    robot._board, robot._board_task, robot._linked = SimulatedBoard(world), None, False
    robot._board.homed = False
    point = garage.station._point
    point._open_contactor()
    point.held = False
    point.enable()
