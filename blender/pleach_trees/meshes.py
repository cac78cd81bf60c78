"""Meshes from arrays."""

from __future__ import annotations

from typing import Any, Sequence

import bpy
import numpy as np

from .curves import put
from .wind_data import put_wind


def points(name: str, positions: Any, along: Any, across: Any, shapes: Any) -> Any:
    """A mesh of points that leaves are put on."""
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(positions))
    if len(positions):
        mesh.vertices.foreach_set("co", np.ascontiguousarray(positions, np.float32).ravel())
    put(mesh, "along", "FLOAT_VECTOR", "POINT", along)
    put(mesh, "across", "FLOAT_VECTOR", "POINT", across)
    put(mesh, "shape", "INT", "POINT", shapes)
    return mesh


def triangles(name: str, positions: Any, faces: Any) -> Any:
    """A smooth mesh of triangles."""
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(positions))
    mesh.vertices.foreach_set("co", np.ascontiguousarray(positions, np.float32).ravel())
    corners = np.ascontiguousarray(faces, np.int32)
    mesh.loops.add(corners.size)
    mesh.loops.foreach_set("vertex_index", corners.ravel())
    mesh.polygons.add(len(corners))
    mesh.polygons.foreach_set("loop_start", np.arange(0, corners.size, 3, dtype=np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(len(corners), bool))
    mesh.update(calc_edges=True)
    return mesh


def polygons(name: str, corners: Any, faces: Sequence[Sequence[int]], uvs: Any) -> Any:
    """A small mesh of flat faces, with texture coordinates by vertex."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(map(float, corner)) for corner in corners], [], [list(face) for face in faces])
    layer = mesh.uv_layers.new(name="UVMap")
    order = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", order)
    layer.data.foreach_set("uv", np.ascontiguousarray(np.asarray(uvs, np.float32)[order]).ravel())
    mesh.update()
    return mesh


def of_parts(name: str, parts: dict[str, Any]) -> tuple[Any, list[str]]:
    """One mesh of the parts of a level of ``pleach.Tree.mesh``, with normals, texture coordinates and a material number for
    each part; the numbers of wind, if the parts have some; and the names of the materials in that order."""
    names = list(parts)
    first, positions, normals, uvs, faces, numbers = 0, [], [], [], [], []
    for number, part in enumerate(parts.values()):
        positions.append(part.positions)
        normals.append(part.normals)
        # Pictures start at their foot here.
        uvs.append(part.uvs * (1, -1) + (0, 1))
        faces.append(part.triangles.astype(np.int64) + first)
        numbers.append(np.full(len(part.triangles), number, np.int32))
        first += len(part.positions)
    mesh = triangles(name, np.concatenate(positions), np.concatenate(faces))
    order = np.concatenate(faces).ravel()
    layer = mesh.uv_layers.new(name="UVMap")
    layer.data.foreach_set("uv", np.ascontiguousarray(np.concatenate(uvs)[order], np.float32).ravel())
    mesh.polygons.foreach_set("material_index", np.concatenate(numbers))
    winds = [part.wind for part in parts.values()]
    if all(wind is not None for wind in winds):
        put_wind(mesh, winds)
    mesh.normals_split_custom_set_from_vertices(np.concatenate(normals).tolist())
    return mesh, names
