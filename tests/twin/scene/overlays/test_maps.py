"""Maps and outlines, against the exact workspace."""

from __future__ import annotations

import numpy as np
import pytest
import viser

from twin.geometry import RobotGeometry
from twin.scene.overlays import CONDITION, SAG
from twin.scene.overlays.colors import GOOD_TO_BAD, ColorScale
from twin.scene.overlays.maps import STEP_MM, add_nine_points, condition_picture
from twin.scene.overlays.regions import SAGITTA_MM, reach_of, segments_m
from twin.scene.scene import TwinScene
from twin.statics import SagTables
from twin.workspace import Measure, measure_rows


def test_a_scale_runs_from_its_first_colour_to_its_last() -> None:
    scale = ColorScale(1.0, 3.0, GOOD_TO_BAD)
    assert tuple(scale.rgb(1.0)) == GOOD_TO_BAD[0]
    assert tuple(scale.rgb(2.0)) == GOOD_TO_BAD[2]
    assert tuple(scale.rgb(3.0)) == GOOD_TO_BAD[-1]
    assert tuple(scale.rgb(99.0)) == tuple(scale.rgb(np.inf)) == GOOD_TO_BAD[-1]
    assert scale.rgb(np.zeros((4, 5))).shape == (4, 5, 3)
    assert tuple(ColorScale(2.0, 2.0, GOOD_TO_BAD).rgb(2.0)) == GOOD_TO_BAD[0]


def test_the_map_covers_the_reach_and_nothing_else(geometry: RobotGeometry) -> None:
    reach = reach_of(geometry)
    assert reach is not None
    picture = condition_picture(geometry, reach)
    covered = picture[..., 3].sum() / picture[..., 3].max() * STEP_MM**2
    assert covered == pytest.approx(reach.area_mm2, rel=0.01)


def test_the_map_has_the_condition_of_each_row(geometry: RobotGeometry) -> None:
    reach = reach_of(geometry)
    assert reach is not None
    picture = condition_picture(geometry, reach)
    rows = len(picture)
    y = reach.extent.y_min_mm + (np.arange(rows) + 0.5) * STEP_MM
    conditions = measure_rows(geometry, Measure.CONDITION, y.astype(np.float64))
    expected = ColorScale(1.0, 6.0, GOOD_TO_BAD).rgb(conditions)
    middle = picture.shape[1] // 2
    assert np.abs(picture[:, middle, :3].astype(int) - expected).max() <= 6  # rows are not exact
    # Best somewhere inside, worst at the bottom where the legs are flat: row 0 is the lowest.
    assert tuple(picture[0, middle, :3]) == GOOD_TO_BAD[-1]


def test_the_outline_is_closed_and_on_the_boundary(geometry: RobotGeometry) -> None:
    reach = reach_of(geometry)
    assert reach is not None
    segments = segments_m(reach) * 1000
    assert segments[0, 0] == pytest.approx(segments[-1, 1])
    length = np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1).sum()
    assert length == pytest.approx(reach.perimeter_mm, rel=1e-3)
    middles = segments.mean(axis=1)[:, :2]
    towards = middles.mean(axis=0) - middles
    inwards = middles + 4 * SAGITTA_MM * towards / np.linalg.norm(towards, axis=1, keepdims=True)
    assert reach.contains_many(inwards.astype(float)).mean() > 0.9


def test_the_nine_points_stand_where_the_table_says(server: viser.ViserServer) -> None:
    tables = SagTables(alpha_x_mm=(500.0, 600.0, 720.0), alpha_y_mm=(300.0, 350.0, 420.0))
    add_nine_points(server.scene, RobotGeometry(), tables)
    cloud = server.scene._handle_from_node_name[f"{SAG.nodes[0]}/points"]
    assert isinstance(cloud, viser.PointCloudHandle)
    points = np.asarray(cloud.points) * 1000
    assert points[0] == pytest.approx([500, 300, 0])
    assert points[1] == pytest.approx([600, 300, 0])
    assert points[8] == pytest.approx([720, 420, 0])


def test_the_legend_says_where_the_colours_end(scene: TwinScene, server: viser.ViserServer) -> None:
    assert scene
    label = server.scene._handle_from_node_name[f"{CONDITION.nodes[0]}/legend/high"]
    assert isinstance(label, viser.LabelHandle)
    assert label.text == "condition ≥ 6"
