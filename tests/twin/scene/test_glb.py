"""The files that the browser loads."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from twin.geometry import RobotGeometry
from twin.scene import car, plug_parts, robot_parts, room
from twin.scene.glb import Part, to_glb
from twin.scene.materials import GUESSED, LAMP, PAINT_FADING, STEEL, Material
from twin.scene.shapes import Mesh, quad, rod, without_waste


def read(glb: bytes) -> tuple[dict[str, Any], bytes]:
    """The two chunks of a binary glTF file."""
    magic, version, total = struct.unpack_from("<4sII", glb)
    assert (magic, version, total) == (b"glTF", 2, len(glb))
    length, kind = struct.unpack_from("<I4s", glb, 12)
    assert kind == b"JSON"
    assert length % 4 == 0
    document = json.loads(glb[20 : 20 + length])
    data_length, kind = struct.unpack_from("<I4s", glb, 20 + length)
    assert kind == b"BIN\0"
    data = glb[28 + length :]
    assert len(data) == data_length == document["buffers"][0]["byteLength"]
    return document, data


def array(document: dict[str, Any], data: bytes, index: int) -> NDArray[Any]:
    accessor = document["accessors"][index]
    view = document["bufferViews"][accessor["bufferView"]]
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[accessor["type"]]
    dtype = {5126: "<f4", 5123: "<u2", 5121: "u1"}[accessor["componentType"]]
    assert view["byteOffset"] % 4 == 0
    stride = view.get("byteStride", width * np.dtype(dtype).itemsize)
    shape = (accessor["count"], width)
    strides = (stride, np.dtype(dtype).itemsize)
    return np.ndarray(shape, dtype, data, view["byteOffset"], strides)


def test_positions_come_out_in_metres_and_faces_unchanged() -> None:
    mesh = rod(20, 100)
    document, data = read(to_glb([(mesh, STEEL)]))
    primitive = document["meshes"][0]["primitives"][0]
    steps = array(document, data, primitive["attributes"]["POSITION"])
    node = document["nodes"][0]
    positions = steps * node["scale"][0] + node["translation"]
    used = without_waste(mesh)
    # A step is the largest extent, 100 mm, divided by 65535.
    assert positions == pytest.approx(used.vertices_mm / 1000, abs=0.8e-6)
    assert len(set(node["scale"])) == 1
    bounds = document["accessors"][primitive["attributes"]["POSITION"]]
    assert bounds["min"] == steps.min(axis=0).tolist()
    assert bounds["max"] == steps.max(axis=0).tolist()
    faces = array(document, data, primitive["indices"]).reshape(-1, 3)
    assert (faces == used.faces).all()


def test_what_is_round_is_shaded_round_though_no_normals_are_sent() -> None:
    document, _ = read(to_glb([(rod(20, 100), STEEL)]))
    attributes = document["meshes"][0]["primitives"][0]["attributes"]
    normals = document["accessors"][attributes["NORMAL"]]
    # Without normals a browser shades facets; with zeros it works them out.
    assert "bufferView" not in normals
    assert normals["count"] == document["accessors"][attributes["POSITION"]]["count"]


def test_triangles_without_area_and_unused_vertices_are_left_out() -> None:
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [9, 9, 9]], dtype=float)
    faces = np.array([[0, 1, 2], [0, 1, 1]], dtype=np.uint32)
    mesh = without_waste(Mesh(vertices, faces, alpha=np.array([0.1, 0.2, 0.3, 0.4])))
    assert mesh.vertices_mm.tolist() == vertices[:3].tolist()
    assert mesh.faces.tolist() == [[0, 1, 2]]
    assert mesh.alpha is not None
    assert mesh.alpha.tolist() == [0.1, 0.2, 0.3]


def test_parts_of_one_material_are_one_mesh() -> None:
    document, _ = read(to_glb([(rod(1, 1), STEEL), (rod(2, 2), LAMP), (rod(3, 3), STEEL)]))
    assert len(document["meshes"][0]["primitives"]) == len(document["materials"]) == 2


def test_colours_are_linear_light() -> None:
    document, _ = read(to_glb([(rod(1, 1), Material("grey", (188, 0, 255), glow=0.5))]))
    material = document["materials"][0]
    assert material["pbrMetallicRoughness"]["baseColorFactor"] == pytest.approx(
        [0.503, 0, 1, 1], abs=1e-3
    )
    assert material["emissiveFactor"] == pytest.approx([0.2515, 0, 0.5], abs=1e-3)


def test_a_texture_and_an_opacity_arrive_as_they_were() -> None:
    paper = Material("paper", (255, 255, 255), texture_png=b"\x89PNG picture")
    square = quad(10, 10)
    fading = Mesh(square.vertices_mm, square.faces, alpha=np.array([0, 0.5, 1, 1]))
    document, data = read(to_glb([(square, paper), (fading, PAINT_FADING)]))
    view = document["bufferViews"][document["images"][0]["bufferView"]]
    assert data[view["byteOffset"] :][: view["byteLength"]] == b"\x89PNG picture"
    textured, faded = document["meshes"][0]["primitives"]
    uv = array(document, data, textured["attributes"]["TEXCOORD_0"])
    assert uv.tolist() == [[0, 1], [1, 1], [1, 0], [0, 0]]
    assert document["materials"][faded["material"]]["alphaMode"] == "BLEND"
    colors = array(document, data, faded["attributes"]["COLOR_0"])
    assert colors[:, 3].tolist() == [0, 128, 255, 255]


def test_too_many_vertices_are_refused() -> None:
    with pytest.raises(ValueError, match="65535"):
        to_glb([(rod(1, 1, count=20_000), STEEL)])


def test_what_is_seen_through_says_so() -> None:
    document, _ = read(to_glb([(rod(1, 1), GUESSED), (rod(2, 2), LAMP)]))
    through, solid = document["materials"]
    assert through["alphaMode"] == "BLEND"
    assert through["pbrMetallicRoughness"]["baseColorFactor"][3] == GUESSED.opacity
    assert "alphaMode" not in solid


EVERY_PART: dict[str, Callable[[RobotGeometry], list[Part]]] = {
    "rails": robot_parts.rails,
    "left carriage": robot_parts.left_carriage,
    "right carriage": robot_parts.right_carriage,
    "bar": robot_parts.bar,
    "platform": robot_parts.platform,
    "floor": room.floor,
    "wall": room.wall,
    "wall base": room.wall_base,
    "station": lambda _: room.station(),
    "camera": lambda _: robot_parts.camera_body(120, -15, -50),
    "slide": lambda g: plug_parts.slide(-200, g.rho3.min_mm, g.rho3.max_mm),
    "plug": lambda _: plug_parts.plug(),
    "body": lambda g: car.body(g.theta_rad),
    "inlet": lambda _: car.inlet(),
    "wheel": lambda _: car.wheel(),
    "label": lambda _: car.label(),
}


@pytest.mark.parametrize("name", EVERY_PART)
@pytest.mark.parametrize(
    "geometry",
    [
        RobotGeometry(),
        RobotGeometry(leg_length_mm=700, base_width_mm=1500, e1y_mm=30, e2y_mm=-20, e_py_mm=60),
        RobotGeometry(platform_width_mm=60, e_py_mm=0, theta_rad=0.3),
    ],
    ids=["default", "uneven", "narrow"],
)
def test_every_part_has_finite_triangles_with_an_area(name: str, geometry: RobotGeometry) -> None:
    parts = EVERY_PART[name](geometry)
    read(to_glb(parts))
    for mesh, _ in parts:
        assert np.isfinite(mesh.vertices_mm).all()
        a, b, c = (mesh.vertices_mm[mesh.faces[:, i]] for i in range(3))
        areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        # Only the tips of lathes and the corners of fans may be points.
        assert (areas > 1e-9).mean() > 0.6
