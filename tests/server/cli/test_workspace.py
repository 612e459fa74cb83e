"""`plugpilot workspace`: what it prints, draws, refuses and finds."""

from __future__ import annotations

import json
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from server.cli import main
from server.config import load_settings
from twin.geometry import RobotGeometry
from twin.study.plots.files import FIGURES
from twin.study.report import StudyReport
from twin.study.search_report import SearchReport

pytestmark = pytest.mark.usefixtures("clean_environment")


def run(*arguments: str) -> Result:
    return CliRunner().invoke(main, ["workspace", *arguments])


def document(*arguments: str) -> dict[str, Any]:
    result = run(*arguments, "--json")
    assert result.exit_code == 0, result.output
    found: dict[str, Any] = json.loads(result.stdout)
    return found


def write(text: str, name: str = "robot.toml") -> str:
    Path(name).write_text(text, encoding="utf-8")
    return name


def test_json_has_the_figures_of_the_default_robot() -> None:
    found = document()
    assert found["area_mm2"] == pytest.approx(113_351.14, abs=0.01)
    assert found["largest_square"]["side_mm"] == pytest.approx(224.388, abs=1e-3)
    assert found["largest_square"]["center_mm"] == pytest.approx([650, 335.627], abs=1e-2)
    square = found["regular_square"]
    assert (square["side_mm"], square["center_mm"], square["fits"]) == (200, [650, 335], True)
    assert square["margins_mm"] == pytest.approx(
        {"rho1_min": 17.717, "rho1_max": 31.266, "rho2_min": 17.717, "rho2_max": 31.266}, abs=1e-3
    )
    placements = found["placements"]
    assert placements["side_mm"] == 200
    assert placements["area_mm2"] == pytest.approx(1243.47, abs=0.01)
    assert placements["boundary"][0] == placements["boundary"][-1]
    assert all(len(point) == 2 for point in placements["boundary"])


def test_the_schema_describes_the_json() -> None:
    schema = json.loads(run("--schema").stdout)
    assert schema["title"] == StudyReport.__name__
    assert set(document()) == set(schema["properties"])
    assert json.loads(run("--schema", "--optimise").stdout)["title"] == SearchReport.__name__


def test_people_get_tables() -> None:
    result = run()
    assert result.exit_code == 0
    for words in (
        "area              113351.1 mm2",
        "largest square    224.39 about (650.0, 335.6)",
        "regular square    200 x 200 about (650.0, 335.0): inside, 17.7 left at rho1 start",
        "condition number  at most 2.031, at y = 235.0",
        "largest force     rho1, withdrawing: 53.7 N of 100 N",
        "upper right   750.0  435.0  388.7  188.7",
        "Stroke left in the corners of the regular square (mm)",
        "abscissa of B   -7.28       363.73",
        "(k)  occupied space",
        "not decidable",
    ):
        assert words in result.stdout
    assert "\x1b" not in result.stdout  # no colours in a pipe


def test_a_geometry_file_sets_what_it_names_and_keeps_the_rest() -> None:
    found = document("--geometry", write("[geometry.rho1]\nmax_mm = 400\n"))
    assert found["geometry"]["rho1"] == {"min_mm": 0, "max_mm": 400}
    assert found["geometry"]["rho2"] == {"min_mm": 0, "max_mm": 420}
    assert found["regular_square"]["margins_mm"]["rho1_max"] == pytest.approx(11.266, abs=1e-3)


def test_a_geometry_file_may_be_a_whole_configuration_of_another_robot() -> None:
    """Sections of the software are passed over, even if that robot could not use them."""
    file = write(
        "[server]\nport = 9000\n[park]\nx_mm = 100\n[geometry]\nbase_width_mm = 1280\n"
        "[geometry.regular_box]\ncenter_x_mm = 640\n"
        "[loads]\ncable_mass_kg = 3\n[actuators]\nrho1_n = 40\n"
    )
    found = document("--geometry", file)
    assert found["geometry"]["base_width_mm"] == 1280
    assert found["largest_force"]["limit_n"] == 40
    assert found["largest_force"]["margin_n"] < 0
    assert "[geometry]" not in run("--geometry", file).stderr


def test_without_a_file_the_settings_in_force_are_studied() -> None:
    write("[geometry.rho2]\nmax_mm = 410\n", "plugpilot.toml")
    assert document()["geometry"]["rho2"]["max_mm"] == 410


@pytest.mark.parametrize(
    ("text", "sentences"),
    [
        ("[geometry]\nleg_length_mm = 100", ("the legs never meet", "lengthen leg_length_mm")),
        ("[geometry]\nleg_length_mm = -5", ("geometry.leg_length_mm = -5", "greater than 0")),
        ("[geometry]\nleg_length_mm = nan", ("must be a finite number",)),
        ("[geometry]\nbase_width_mm = 100", ("the carriages cross", "base_width_mm - e1x_mm")),
        ("[geometry]\nleg_lenth_mm = 500", ("did you mean geometry.leg_length_mm?",)),
        ("leg_length_mm = 500", ("unknown key; did you mean geometry.leg_length_mm?",)),
        ("[geometri]\nleg_length_mm = 5", ("geometri", "did you mean geometry?")),
        ("[geometry.rho1]\nmin_mm = 9\nmax_mm = 3", ("must be greater than min_mm",)),
        ("[geometry]\nrho1 = 4", ("geometry.rho1 = 4", "must be a table")),
        ("[actuators]\nrho1_n = 0", ("actuators.rho1_n = 0", "greater than 0")),
        ("[geometry", ("is not valid TOML",)),
        ("", ("has no section [geometry]", "plugpilot config")),
        ("[server]\nport = 9000", ("has no section [geometry]",)),
        (
            "[geometry]\nleg_length_mm = 300\ne1y_mm = 0\ne2y_mm = 590\nbase_width_mm = 1000\n"
            "[geometry.rho1]\nmin_mm = 0\nmax_mm = 60\n[geometry.rho2]\nmin_mm = 0\nmax_mm = 60",
            ("legs never meet",),
        ),
    ],
)
def test_a_robot_that_cannot_be_is_named_with_what_to_change(
    text: str, sentences: tuple[str, ...]
) -> None:
    result = run("--geometry", write(text), "--plot", "figures")
    assert result.exit_code == 2
    for sentence in sentences:
        assert sentence in result.stderr
    assert result.stdout == ""
    assert "Traceback" not in result.output
    assert not Path("figures").exists()


def test_a_robot_that_reaches_nothing_is_refused_and_not_drawn() -> None:
    # the legs close, but only leaning outwards
    file = write(
        "[geometry]\nleg_length_mm = 900\nbase_width_mm = 700\ne1y_mm = 0\ne2y_mm = 800\n"
        "[geometry.rho1]\nmin_mm = 0\nmax_mm = 10\n[geometry.rho2]\nmin_mm = 0\nmax_mm = 10\n"
    )
    result = run("--geometry", file, "--plot", "figures")
    assert result.exit_code == 2
    assert "in [geometry]" in result.stderr
    assert result.stdout == ""
    assert not Path("figures").exists()


def test_a_file_that_is_not_there() -> None:
    result = run("--geometry", "none.toml")
    assert result.exit_code == 2
    assert "none.toml cannot be read (No such file" in result.stderr


def test_pictures_are_written_and_named(monkeypatch: pytest.MonkeyPatch) -> None:
    two = {name: FIGURES[name] for name in ("workspace", "placements")}  # drawing takes its time
    monkeypatch.setattr("twin.study.plots.files.FIGURES", two)
    result = run("--plot", "figures", "--format", "svg", "--json")
    assert result.exit_code == 0
    assert result.stderr.splitlines() == [f"wrote figures/{name}.svg" for name in two]
    for name in two:
        text = Path(f"figures/{name}.svg").read_text(encoding="utf-8")
        assert text.startswith("<?xml")
        assert text.count("<path") > 50
    assert json.loads(result.stdout)["area_mm2"] > 0  # the files are told on the other channel


def test_a_folder_that_cannot_be_written() -> None:
    write("", "taken")
    result = run("--plot", "taken")
    assert result.exit_code == 2
    assert "cannot be written into taken (" in result.stderr
    assert "Name a folder" in result.stderr


def test_the_optimum_can_be_fed_back_and_passes() -> None:
    result = run("--optimise", "--box", "220x180x20", "--margin-mm", "12", "--max-condition", "2.5")
    assert result.exit_code == 0, result.output
    assert "Smallest area" in result.stderr
    geometry = tomllib.loads(result.stdout)["geometry"]
    assert RobotGeometry.model_validate(geometry).regular_box.width_mm == 220
    found = document("--geometry", write(result.stdout, "smaller.toml"))
    assert found["geometry"] == geometry
    assert found["regular_square"]["fits"]
    assert found["box"]["fits"]
    assert min(found["box"]["margins_mm"].values()) >= 12
    assert found["worst_condition"]["value"] <= 2.5
    assert found["largest_force"]["margin_n"] >= 0


def test_the_optimum_starts_the_software_with_a_park_position_of_its_own() -> None:
    text = run("--optimise").stdout
    box = tomllib.loads(text)["geometry"]["regular_box"]
    park = f"[park]\nx_mm = {box['center_x_mm']}\ny_mm = {box['center_y_mm']}\n"
    settings = load_settings(Path(write(park + text)))
    assert settings.geometry.leg_length_mm == 323


def test_the_optimum_as_json() -> None:
    found = document("--optimise", "--objective", "base_width", "--seed", "3")
    assert found["objective"] == "base_width"
    assert found["value"] == found["geometry"]["base_width_mm"] < found["start_value"] == 1300
    assert found["start_passed"]
    checks = {check["demand"]: check for check in found["checks"]}
    assert all(check["passed"] for check in checks.values())
    assert checks["condition"]["binding"]
    assert checks["condition"]["found"] <= checks["condition"]["limit"] == 3
    assert document("--optimise", "--objective", "base_width", "--seed", "3") == found


def test_options_of_the_search_arrive() -> None:
    found = document(
        "--optimise", "--vary", "platform_width_mm=200:220", "--vary", "e1x_mm=10",
        "--max-force-n", "60", "--max-base-width-mm", "1400",
    )  # fmt: skip
    assert 200 <= found["geometry"]["platform_width_mm"] <= 220
    assert found["geometry"]["e1x_mm"] == 10
    checks = {check["demand"]: check for check in found["checks"]}
    assert checks["carriage_force"]["limit"] == 60
    assert checks["carriage_force"]["found"] <= 60


def test_nothing_found_says_what_stands_in_the_way() -> None:
    result = run("--optimise", "--max-stroke-mm", "200")
    assert result.exit_code == 1
    assert "exceeds stroke by" in result.stderr
    assert "without the demand on stroke there is one" in result.stderr
    assert result.stdout == ""


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--seed", "4"], "--seed goes with --optimise only."),
        (["--box", "1x1x1"], "--box goes with --optimise only."),
        (["--optimise", "--box", "200x200"], "is not a box such as 200x200x20"),
        (["--optimise", "--box", "200x-2x20"], "not between 0 and 10000 mm"),
        (["--optimise", "--box", "200xnanx20"], "not between 0 and 10000 mm"),
        (["--optimise", "--vary", "L=3:4"], "with a NAME of leg_length_mm"),
        (["--optimise", "--vary", "e1x_mm=9:4"], "LOW first"),
        (["--optimise", "--vary", "e1x_mm=a:b"], "LOW and HIGH must be lengths in mm"),
        (["--optimise", "--margin-mm", "nan"], "is not a number"),
        (["--optimise", "--max-condition", "0.5"], "--max-condition"),
        (["--format", "gif"], "--format"),
    ],
)
def test_wrong_options_are_refused(arguments: list[str], sentence: str) -> None:
    result = run(*arguments)
    assert result.exit_code == 2
    assert sentence in result.stderr


def test_figures_do_not_wait_for_the_drawing_library() -> None:
    code = (
        "import sys; from server.cli import main;"
        "main(['workspace', '--json'], standalone_mode=False);"
        "print('matplotlib' in sys.modules, file=sys.stderr)"
    )
    result = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    assert result.stderr.strip() == "False"
