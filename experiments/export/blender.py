"""Imports GLB files into Blender and says what arrived.

    blender --background --factory-startup --python-exit-code 1 --python experiments/export/blender.py -- \
        --csv blender.csv [--picture tree.png] FILE.glb ...

With `--check` alone, imports what the importer needs and ends: with 1 where something is missing.
Writes a row a file: objects, materials, vertices, triangles, height in metres, and seconds. With
`--picture`, the last file is rendered with Cycles. Runs inside Blender's own Python.
"""

import argparse
import csv
import math
import sys
import time
from pathlib import Path

import bpy
# Blender's own importer needs it, and Debian's package of Blender only recommends it.
import numpy
from mathutils import Vector

# Blender 3.4's importer uses a name that NumPy dropped in 1.24, and Debian ships the two together.
if not hasattr(numpy, "bool"):
    numpy.bool = bool

COLUMNS = ["file", "objects", "materials", "vertices", "triangles", "height_m", "wall_import_s"]


def meshes():
    return [thing for thing in bpy.context.scene.objects if thing.type == "MESH"]


def corners():
    """The corners of the boxes around all meshes, in the scene's coordinates."""
    return [thing.matrix_world @ Vector(corner) for thing in meshes() for corner in thing.bound_box]


def load(path):
    """Imports a file into an empty scene; returns its row."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    start = time.perf_counter()
    bpy.ops.import_scene.gltf(filepath=str(path))
    seconds = time.perf_counter() - start
    found = meshes()
    triangles = 0
    for thing in found:
        thing.data.calc_loop_triangles()
        triangles += len(thing.data.loop_triangles)
    height = max((corner.z for corner in corners()), default=0.0)
    materials = {slot.material.name for thing in found for slot in thing.material_slots if slot.material}
    return [
        path.stem, len(found), " ".join(sorted(materials)),
        sum(len(thing.data.vertices) for thing in found), triangles, f"{height:.2f}", f"{seconds:.2f}",
    ]


def render(path, side):
    """A picture of what is loaded: sun, pale sky, camera from the front."""
    low = Vector(min(corner[axis] for corner in corners()) for axis in range(3))
    high = Vector(max(corner[axis] for corner in corners()) for axis in range(3))
    middle, size = (low + high) / 2, max(high - low)
    scene = bpy.context.scene
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = middle + Vector((0, -2.9 * size, 0.15 * size))
    camera.rotation_euler = (Vector(middle) - camera.location).to_track_quat("-Z", "Y").to_euler()
    camera.data.angle = math.radians(24)
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy, sun.rotation_euler = 4.0, (math.radians(45), 0, math.radians(-40))
    for thing in (camera, sun):
        scene.collection.objects.link(thing)
    scene.camera = camera
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.75, 0.85, 1.0, 1.0)
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.seed = 24, False, 1
    scene.view_settings.view_transform = "Standard"
    scene.render.resolution_x = scene.render.resolution_y = side
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.image_settings.compression = 100
    scene.render.filepath = str(Path(path).resolve())
    bpy.ops.render.render(write_still=True)


def check():
    """Imports the add-on's importer, which Blender itself does only with the first file."""
    from io_scene_gltf2.blender.imp import gltf2_blender_gltf
    from io_scene_gltf2.io.imp import gltf2_io_gltf

    print(gltf2_blender_gltf.__name__, gltf2_io_gltf.__name__, "with NumPy", numpy.__version__)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--csv", required=True)
    parser.add_argument("--picture")
    parser.add_argument("--side", type=int, default=200)
    parser.add_argument("files", nargs="+", type=Path)
    given = sys.argv[sys.argv.index("--") + 1:]
    if given == ["--check"]:
        check()
        return
    arguments = parser.parse_args(given)
    rows = [load(path) for path in arguments.files]
    with open(arguments.csv, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(rows)
    if arguments.picture:
        render(arguments.picture, arguments.side)


main()
