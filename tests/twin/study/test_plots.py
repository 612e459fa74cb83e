"""What is in the pictures: the elements drawn, not their pixels alone."""

from __future__ import annotations

import math
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import imread
from matplotlib.patches import Rectangle as RectanglePatch

from twin.geometry import RegularBox, RobotGeometry
from twin.study.demands import Demands
from twin.study.plots.deflection import draw_deflection
from twin.study.plots.files import FIGURES, write_figures
from twin.study.plots.lame import COLOURS, draw_lame, lame_curve
from twin.study.plots.maps import draw_maps, map_panels
from twin.study.plots.placements import draw_placements
from twin.study.plots.singular import draw_singular, singular_postures
from twin.study.plots.style import LIMIT_COLOURS, printed_page
from twin.study.plots.workspace import draw_workspace
from twin.workspace import EmptyWorkspaceError, Limit, reachable_region
from twin.workspace.boundary import Array

DEFAULT = RobotGeometry()


def lines_of(axes: Axes, colour: str) -> list[Array]:
    return [np.asarray(line.get_xydata()) for line in axes.lines if line.get_color() == colour]


def texts_of(figure: Figure) -> str:
    return "\n".join(text.get_text() for axes in figure.axes for text in axes.texts)


def test_the_arcs_of_the_workspace_are_drawn_where_they_are() -> None:
    figure = draw_workspace(DEFAULT)
    (axes,) = figure.axes
    assert axes.get_aspect() == 1
    assert "(mm)" in axes.get_xlabel()
    assert "(mm)" in axes.get_ylabel()
    # rho1 at its start: a circle of radius L about the left foot, here x = e1x + L3/2 = 55
    (arc,) = lines_of(axes, LIMIT_COLOURS[Limit.RHO1_MIN])
    assert np.hypot(arc[:, 0] - 55, arc[:, 1]) == pytest.approx(532)
    (arc,) = lines_of(axes, LIMIT_COLOURS[Limit.RHO2_MAX])
    assert np.hypot(arc[:, 0] - 825, arc[:, 1]) == pytest.approx(532)
    squares = [patch for patch in axes.patches if isinstance(patch, RectanglePatch)]
    sizes = {(p.get_label(), round(p.get_width(), 1)) for p in squares}
    assert sizes == {
        ("largest square, 224.4 mm", 224.4),
        (r"regular square, 200 $\times$ 200 mm", 200.0),
    }
    assert all(f"${name}$" in texts_of(figure) for name in "ABCDEFV")


def test_a_square_outside_is_drawn_where_it_is_and_named_so() -> None:
    figure = draw_workspace(RobotGeometry(regular_box=RegularBox(center_x_mm=1100)))
    (axes,) = figure.axes
    labels = [str(patch.get_label()) for patch in axes.patches]
    assert any(label.endswith("not inside") for label in labels)
    assert axes.get_xlim()[1] > 1200
    assert "$A$" not in texts_of(figure)  # the robot does not get there, so it is not drawn


def test_the_placements_carry_the_coordinates_of_their_corners() -> None:
    figure = draw_placements(DEFAULT)
    texts = texts_of(figure)
    for corner in ("(650.0, 355.4)", "(650.0, 294.9)", "(628.8, 341.9)", "(671.2, 341.9)"):
        assert corner in texts
    assert "1243 mm" in figure.axes[1].get_title("left")
    dashed = [p for p in figure.axes[0].patches if isinstance(p, RectanglePatch)]
    assert len(dashed) == 5  # about four corners of the centres, and the regular one


def test_no_placement_is_said_in_words() -> None:
    robot = RobotGeometry(regular_box=RegularBox(width_mm=400, height_mm=400))
    assert "It fits nowhere." in texts_of(draw_placements(robot))


def test_the_lame_curves_are_what_their_equation_says() -> None:
    x, y = lame_curve(650, 335, 100, 6).T
    assert ((x - 650) ** 6 + (y - 335) ** 6) / 100**6 == pytest.approx(1)
    figure = draw_lame(DEFAULT)
    assert "square that fits: 224.0 mm" in texts_of(figure)
    assert "claimed by $n = 6$: 248.2 mm" in texts_of(figure)
    # in the right panel the curves end at the workspace: they touch it and do not leave it
    region = reachable_region(DEFAULT)
    for colour in COLOURS:
        (curve,) = lines_of(figure.axes[1], colour)
        shrunk = (curve - [650, 335]) * 0.9999 + [650, 335]
        grown = (curve - [650, 335]) * 1.002 + [650, 335]
        assert region.contains_many(shrunk).all()
        assert not region.contains_many(grown).all()
    outside = RobotGeometry(regular_box=RegularBox(center_x_mm=1100))
    assert "The centre is out of reach." in texts_of(draw_lame(outside))


def test_the_nine_points_carry_number_and_value() -> None:
    figure = draw_deflection(DEFAULT)
    texts = texts_of(figure).split("\n")
    assert texts.count("1.030") == 2
    for label in ("1", "9", "0.989", "1.010", "1.080", "0.907"):
        assert label in texts
    assert figure.get_suptitle() == ""
    other = draw_deflection(RobotGeometry(leg_length_mm=600))
    assert other.get_suptitle().startswith("Computed for another robot: L = 532")


def test_the_singular_postures_are_singular() -> None:
    parallel, serial, flat = singular_postures(DEFAULT)
    assert parallel.legs.h1_mm == 0
    assert parallel.legs.d1_mm == pytest.approx(532)
    assert parallel.remark == "Within the strokes."
    assert serial.legs.d1_mm == 0
    assert serial.v.y_mm == pytest.approx(532)
    assert serial.remark == "175 mm beyond the strokes."
    assert "no flat one exists" in flat.title
    above = singular_postures(RobotGeometry(e_py_mm=80))[2]
    assert "no flat one" not in above.title
    # AB parallel to BF = (L3/2, e_py): at 45 deg for 80 and 80
    assert above.v.y_mm == pytest.approx(532 / math.sqrt(2), abs=0.5)
    assert len(draw_singular(DEFAULT).axes) == 3


def test_a_singular_posture_within_the_strokes_is_drawn_there() -> None:
    robot = RobotGeometry.model_validate(
        {"rho1": {"min_mm": 0, "max_mm": 640}, "rho2": {"min_mm": 0, "max_mm": 560}}
    )
    serial = singular_postures(robot)[1]
    assert serial.remark == "Within the strokes."
    region = reachable_region(robot)
    assert region.contains(serial.v.x_mm, serial.v.y_mm - 1e-6)


def test_maps_show_what_the_model_says() -> None:
    x, y = np.array([650.0]), np.array([100.0, 235.0, 335.0])
    panels = map_panels(DEFAULT, Demands(), x, y)
    condition, inserting, withdrawing, _, stroke, parallelogram = (
        panel.values[:, 0] for panel in panels
    )
    assert condition[1] == pytest.approx(math.sqrt(532**2 - 235**2) / 235)
    assert withdrawing[1] == pytest.approx(53.672, abs=1e-3)
    assert (withdrawing > inserting).all()
    assert (np.diff(withdrawing) < 0).all()
    reach = math.sqrt(532**2 - 335**2)
    assert stroke[2] == pytest.approx(min(595 - reach, 420 - (595 - reach)))
    assert (parallelogram > 0.7).all()
    figure = draw_maps(DEFAULT)
    titles = [axes.get_title("left")[:3] for axes in figure.axes if axes.get_title("left")]
    assert titles == ["(a)", "(b)", "(c)", "(d)", "(e)", "(f)"]


@pytest.fixture(scope="module")
def pictures(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("pictures") / "made" / "for them"
    return {path.stem: path for path in write_figures(DEFAULT, folder, dots_per_inch=100)}


def test_every_picture_has_ink_all_over(pictures: dict[str, Path]) -> None:
    assert set(pictures) == set(FIGURES)
    for name, path in pictures.items():
        picture = imread(path)[..., :3]
        height, width = picture.shape[:2]
        assert width > 400, name
        inked = (picture.min(axis=2) < 0.9).reshape(height, width)
        # something in each third of the height and of the width
        for part in (*np.array_split(inked, 3), *np.array_split(inked, 3, axis=1)):
            assert part.mean() > 0.002, name


def test_svg_is_the_same_to_the_last_byte(tmp_path: Path) -> None:
    for folder in ("a", "b"):
        next(write_figures(DEFAULT, tmp_path / folder, "svg"))
    first, again = ((tmp_path / folder / "workspace.svg").read_bytes() for folder in ("a", "b"))
    assert first == again
    assert first.startswith(b"<?xml")
    assert b"<text" not in first  # letters are outlines


def test_the_users_own_style_is_left_alone() -> None:
    before = mpl.rcParams["font.size"]
    with printed_page():
        assert mpl.rcParams["font.family"] == ["STIXGeneral"]
    assert mpl.rcParams["font.size"] == before


def test_a_robot_without_workspace_is_not_drawn(tmp_path: Path) -> None:
    # a checked geometry cannot be like this; a copy is not checked
    robot = DEFAULT.model_copy(update={"base_width_mm": 3000.0})
    with pytest.raises(EmptyWorkspaceError):
        list(write_figures(robot, tmp_path))
