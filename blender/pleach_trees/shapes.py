"""The objects that stand for leaves and blossoms, in collections that a user may fill otherwise."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from . import materials, meshes

#: The collection that holds all collections of shapes, out of sight.
ALL = "pleach shapes"
OWN = "pleach_shape"


def shelf() -> Any:
    """The collection of all shapes: in the scene, so that one finds it, and left out of every view layer."""
    found = bpy.data.collections.get(ALL) or bpy.data.collections.new(ALL)
    for scene in bpy.data.scenes:
        if found.name not in scene.collection.children:
            scene.collection.children.link(found)
            for layer in scene.view_layers:
                layer.layer_collection.children[found.name].exclude = True
    return found


def outlines(tree: Any) -> list[tuple[str, Any, list[list[int]], Any]]:
    """Leaves: name, corners, faces, texture coordinates."""
    shapes = []
    for name, corners in tree.leaf_outlines:
        widest = max(float(np.abs(corners[:, 0]).max()), 1e-6)
        flat = np.column_stack([corners, np.zeros(len(corners), np.float32)])
        uvs = np.column_stack([0.5 + 0.5 * corners[:, 0] / widest, corners[:, 1]])
        shapes.append((name, flat, [list(range(len(corners)))], uvs))
    return shapes


def blossoms(tree: Any) -> list[tuple[str, Any, list[list[int]], Any]]:
    """Blossoms, likewise."""
    shapes = []
    for name, corners, faces in tree.blossom_faces:
        widest = max(float(np.abs(corners[:, [0, 2]]).max()), 1e-6)
        shapes.append((name, corners, faces, 0.5 + 0.5 * corners[:, [0, 2]] / widest))
    return shapes


def fill(collection: Any, name: str, kind: str, shapes: list[Any], color: tuple[int, int, int]) -> Any:
    """Puts shapes into their collection; into a new one if it is None. A collection in which a user has put, replaced or
    edited anything stays as it is, but for the colour of a material that was not changed."""
    if collection is None:
        collection = bpy.data.collections.new(f"{name} {kind} shapes")
        collection[OWN] = True
        shelf().children.link(collection)
    things = list(collection.objects)
    material = next((slot.material for thing in things if OWN in thing for slot in thing.material_slots if slot.material), None)
    if OWN not in collection or not all(_is_own(thing) for thing in things):
        if material is not None:
            materials.ensure(material, "", kind, color)
        return collection
    wanted = [_digest(shape) for shape in shapes]
    if [thing.get(OWN) for thing in sorted(things, key=lambda thing: thing.name)] == wanted:
        if material is not None:
            materials.ensure(material, "", kind, color)
        return collection
    for thing in things:
        mesh = thing.data
        bpy.data.objects.remove(thing)
        if not mesh.users:
            bpy.data.meshes.remove(mesh)
    if shapes:
        material = materials.ensure(material, f"{name} {kind}", kind, color)
    for number, shape in enumerate(shapes):
        what, corners, faces, uvs = shape
        mesh = meshes.polygons(f"{name} {what}", corners, faces, uvs)
        mesh.materials.append(material)
        # Blender puts shapes in the order of their names.
        thing = bpy.data.objects.new(f"{name} {kind} {number:02} {what}", mesh)
        thing[OWN] = wanted[number]
        collection.objects.link(thing)
    return collection


def _digest(shape: Any) -> str:
    what, corners, faces, _ = shape
    return f"{what} {len(faces)} {_form(np.asarray(corners, np.float32))}"


def _form(corners: Any) -> str:
    """A number that changes with the corners, which an edit in Blender does."""
    weights = np.arange(1, corners.size + 1, dtype=np.float64)
    return f"{len(corners)} {float((corners.ravel() * weights).sum()):.4f}"


def _is_own(thing: Any) -> bool:
    """Whether an object is as it was made."""
    mark = thing.get(OWN)
    if mark is None or thing.type != "MESH" or thing.mode != "OBJECT":
        return False
    corners = np.empty(len(thing.data.vertices) * 3, np.float32)
    thing.data.vertices.foreach_get("co", corners)
    return mark.endswith(_form(corners.reshape(-1, 3)))
