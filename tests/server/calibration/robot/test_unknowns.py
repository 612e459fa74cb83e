"""A look follows from the unknowns, and so do its slopes."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from server.calibration.robot.unknowns import NAMES, Unknowns
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry

DRAWN = RobotGeometry()
RHO = np.array([[150.0, 150.0], [60.0, 330.0], [320.0, 90.0], [230.0, 260.0]])
MOUNT = CameraMount().T_platform_camera[:3, :3]
SPREAD = np.array([3, 3, 3, 3, 0.009, 5e-3, 5e-3, 0.05, 0.05, 0.05, 50, 50, 50, 0.01])


@st.composite
def guesses(draw: st.DrawFn) -> Unknowns:
    first = Unknowns.guess(DRAWN, MOUNT, RHO[0], np.array([5.0, -8.0, 290.0]))
    shares = draw(st.lists(st.floats(-1, 1), min_size=len(NAMES), max_size=len(NAMES)))
    return first.stepped(SPREAD * np.array(shares))


def test_the_first_guess_explains_the_first_look() -> None:
    seen = np.array([5.0, -8.0, 290.0])
    guess = Unknowns.guess(DRAWN, MOUNT, RHO[0], seen)
    np.testing.assert_allclose(guess.predict(RHO[:1])[0], seen, atol=1e-9)


def test_a_platform_that_goes_right_sees_the_label_go_left() -> None:
    guess = Unknowns.guess(DRAWN, MOUNT, RHO[0], np.array([0.0, 0.0, 290.0]))
    # rho1 and rho2 against each other move V along x only; the camera is mounted upside down
    here, there = guess.predict(np.array([[150.0, 150.0], [160.0, 140.0]]))
    np.testing.assert_allclose(there - here, [10.0, 0.0, 0.0], atol=1e-6)


@given(guesses())
@settings(max_examples=30)
def test_derivatives_are_the_slopes(guess: Unknowns) -> None:
    found = guess.derivatives(RHO)
    for number, name in enumerate(NAMES):
        step = np.zeros(len(NAMES))
        step[number] = 1e-3 if name.endswith("mm") else 1e-5
        slope = guess.stepped(step).predict(RHO) - guess.stepped(-step).predict(RHO)
        np.testing.assert_allclose(
            found[..., number], slope / (2 * step[number]), rtol=1e-4, atol=1e-3, err_msg=name
        )


@given(guesses(), st.floats(0.9, 1.1))
def test_nobody_sees_the_scale_of_everything(guess: Unknowns, factor: float) -> None:
    scaled = guess.values.copy()
    built = guess.built
    scaled[[0, 1, 5, 6, 12, 13]] *= factor
    for number, foot_mm in ((2, built.left_foot_x_mm), (3, built.left_foot_y_mm)):
        scaled[number] = foot_mm + factor * (scaled[number] - foot_mm)
    for number, foot_mm in ((10, built.left_foot_x_mm), (11, built.left_foot_y_mm)):
        scaled[number] = foot_mm + factor * (scaled[number] - foot_mm)
    np.testing.assert_allclose(
        Unknowns(DRAWN, MOUNT, scaled).predict(RHO), guess.predict(RHO), rtol=0, atol=1e-6
    )
