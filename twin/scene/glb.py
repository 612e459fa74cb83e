"""Writes meshes with their materials as binary glTF, the format that the browser loads.

Layout: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html, section 4.4. Lengths become
metres here. A phone downloads all of it, so it is kept small: positions are 16-bit steps of the
part's largest extent (KHR_mesh_quantization; 0.05 mm for the car), and normals are declared but
not sent: the browser works them out from the triangles anyway, and shades a mesh that declares
none as if it were cut from facets.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from twin.scene.frames import METRES_PER_MM
from twin.scene.materials import Material
from twin.scene.shapes import Mesh, merged, without_waste

Part = tuple[Mesh, Material]
"""A mesh and what it is made of."""

_FLOAT, _UINT16, _UINT8 = 5126, 5123, 5121
_STEPS = 65535
_POSITION_STRIDE = 8
"""Three 16-bit numbers and the padding that the format asks for."""
_VERTEX_BUFFER, _INDEX_BUFFER = 34962, 34963
_MAX_UINT16 = 0xFFFF
_QUANTIZED = "KHR_mesh_quantization"


@dataclass(slots=True)
class _Document:
    json: dict[str, list[Any]] = field(
        default_factory=lambda: {
            key: []
            for key in ("bufferViews", "accessors", "materials", "textures", "images", "samplers")
        }
    )
    data: bytearray = field(default_factory=bytearray)

    def add(self, kind: str, item: dict[str, Any]) -> int:
        self.json[kind].append(item)
        return len(self.json[kind]) - 1

    def add_bytes(self, raw: bytes, **extra: int) -> int:
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(raw)} | extra
        self.data += raw + b"\0" * (-len(raw) % 4)
        return self.add("bufferViews", view)

    def add_array(self, array: NDArray[Any], kind: str, component: int, **extra: object) -> int:
        target = _INDEX_BUFFER if kind == "SCALAR" else _VERTEX_BUFFER
        view = self.add_bytes(np.ascontiguousarray(array).tobytes(), target=target)
        accessor = {"bufferView": view, "componentType": component, "count": len(array)}
        return self.add("accessors", accessor | {"type": kind} | extra)

    def add_positions(self, steps: NDArray[np.uint16]) -> int:
        padded = np.zeros((len(steps), _POSITION_STRIDE // 2), dtype="<u2")
        padded[:, :3] = steps
        view = self.add_bytes(padded.tobytes(), target=_VERTEX_BUFFER, byteStride=_POSITION_STRIDE)
        bounds = {"min": steps.min(axis=0).tolist(), "max": steps.max(axis=0).tolist()}
        accessor = {"bufferView": view, "componentType": _UINT16, "count": len(steps)}
        return self.add("accessors", accessor | {"type": "VEC3"} | bounds)

    def add_unsent_normals(self, count: int) -> int:
        """An accessor without data stands for zeros."""
        return self.add("accessors", {"componentType": _FLOAT, "count": count, "type": "VEC3"})


@dataclass(frozen=True, slots=True)
class _Grid:
    """The 16-bit steps of one file: position = origin + step * size, in mm."""

    origin_mm: NDArray[np.float64]
    step_mm: float

    @classmethod
    def around(cls, meshes: Iterable[Mesh]) -> _Grid:
        vertices = np.concatenate([mesh.vertices_mm for mesh in meshes])
        low = vertices.min(axis=0)
        return cls(low, max(float((vertices.max(axis=0) - low).max()), 1e-3) / _STEPS)

    def steps(self, vertices_mm: NDArray[np.float64]) -> NDArray[np.uint16]:
        return np.round((vertices_mm - self.origin_mm) / self.step_mm).astype(np.uint16)

    @property
    def node(self) -> dict[str, Any]:
        """The node that takes steps to metres."""
        return {
            "mesh": 0,
            "translation": (self.origin_mm * METRES_PER_MM).tolist(),
            "scale": [self.step_mm * METRES_PER_MM] * 3,
        }


def _linear(channel: int) -> float:
    """Linear light of an sRGB value (IEC 61966-2-1)."""
    s = channel / 255
    return s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4


def _add_material(document: _Document, material: Material) -> int:
    linear = [round(_linear(c), 5) for c in material.color]
    surface: dict[str, Any] = {
        "baseColorFactor": [*linear, material.opacity],
        "metallicFactor": material.metallic,
        "roughnessFactor": material.roughness,
    }
    if material.texture_png is not None:
        view = document.add_bytes(material.texture_png)
        image = document.add("images", {"bufferView": view, "mimeType": "image/png"})
        # Nearest when magnified: the modules of a code keep their edges.
        sampler = document.add("samplers", {"magFilter": 9728, "minFilter": 9987})
        texture = document.add("textures", {"source": image, "sampler": sampler})
        surface["baseColorTexture"] = {"index": texture}
    item: dict[str, Any] = {"name": material.name, "pbrMetallicRoughness": surface}
    if material.glow:
        item["emissiveFactor"] = [c * material.glow for c in linear]
    if material.blend or material.opacity < 1:
        item["alphaMode"] = "BLEND"
    return document.add("materials", item)


def _add_mesh(document: _Document, mesh: Mesh, grid: _Grid, material: int) -> dict[str, Any]:
    count = len(mesh.vertices_mm)
    if count > _MAX_UINT16:
        msg = f"a mesh has {count} vertices; a part may have {_MAX_UINT16}"
        raise ValueError(msg)
    attributes = {
        "POSITION": document.add_positions(grid.steps(mesh.vertices_mm)),
        "NORMAL": document.add_unsent_normals(count),
    }
    if mesh.uv is not None:
        attributes["TEXCOORD_0"] = document.add_array(mesh.uv.astype("<f4"), "VEC2", _FLOAT)
    if mesh.alpha is not None:
        colors = np.full((count, 4), 255, dtype=np.uint8)
        colors[:, 3] = np.round(np.clip(mesh.alpha, 0, 1) * 255)
        attributes["COLOR_0"] = document.add_array(colors, "VEC4", _UINT8, normalized=True)
    indices = document.add_array(mesh.faces.ravel().astype("<u2"), "SCALAR", _UINT16)
    return {"attributes": attributes, "indices": indices, "material": material}


def to_glb(parts: Iterable[Part]) -> bytes:
    """One binary glTF file of all parts; parts of the same material are joined.

    Raises:
        ValueError: If a joined mesh has more than 65 535 vertices.
    """
    by_material: dict[Material, list[Mesh]] = {}
    for mesh, material in parts:
        by_material.setdefault(material, []).append(mesh)
    meshes = {material: without_waste(merged(several)) for material, several in by_material.items()}
    document, grid = _Document(), _Grid.around(meshes.values())
    primitives = [
        _add_mesh(document, mesh, grid, _add_material(document, material))
        for material, mesh in meshes.items()
    ]
    tree = {key: items for key, items in document.json.items() if items} | {
        "asset": {"version": "2.0"},
        "extensionsUsed": [_QUANTIZED],
        "extensionsRequired": [_QUANTIZED],
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [grid.node],
        "meshes": [{"primitives": primitives}],
        "buffers": [{"byteLength": len(document.data)}],
    }
    text = json.dumps(tree, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    data = bytes(document.data)
    header = struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + len(data))
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    return header + chunks + struct.pack("<I4s", len(data), b"BIN\0") + data
