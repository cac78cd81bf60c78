"""Renders trees and their levels side by side: `python3 experiments/export/levels.py OUT.png`.

Needs `pip install bpy pillow` (bpy 4.5 and 5.0 are for Python 3.11) and the program `pleach`, of which `--program` gives
the path. Each species is grown as it is and with 50,000, 8,000 and 2,000 triangles, and rendered by Cycles from the
front: as in docs/levels.png.
"""

import argparse
import math
import subprocess
import tempfile
from pathlib import Path

import bpy
from mathutils import Vector
from PIL import Image

SPECIES = ["weeping_willow", "quaking_aspen", "black_oak", "balsam_fir"]
SIDE = 300
WIDTH = 750


def grow(program, species, folder):
    """The files of a species: as it is, and its levels."""
    files = [folder / f"{species}-whole.glb", folder / f"{species}.glb"]
    for path, more in zip(files, (["--finest"], ["--triangles", "50000,8000,2000"])):
        command = [program, "grow", species, "--textures", "1024", *more, "-o", str(path)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return files


def load(files):
    """The objects of all files, the whole tree first and then its levels."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    found = []
    for path in files:
        before = set(bpy.data.objects)
        bpy.ops.import_scene.gltf(filepath=str(path))
        new = [thing for thing in bpy.data.objects if thing not in before and thing.type == "MESH"]
        found += sorted(new, key=lambda thing: thing.name)
    return found


def render(files, path):
    """A row of the trees."""
    trees = load(files)
    corners = [trees[0].matrix_world @ Vector(corner) for corner in trees[0].bound_box]
    height = max(corner.z for corner in corners)
    width = max(2.16 * max(max(abs(corner.x), abs(corner.y)) for corner in corners), 0.8 * height)
    for place, tree in enumerate(trees):
        tree.location.x += width * (place + 0.5)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.seed = 20, False, 1
    scene.cycles.transparent_max_bounces = 64
    scene.render.resolution_x = SIDE * len(trees)
    scene.render.resolution_y = int(SIDE * height * 1.06 / width)
    scene.render.filepath = str(path)
    scene.view_settings.view_transform = "Standard"
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    sky = scene.world.node_tree.nodes["Background"].inputs
    sky["Color"].default_value, sky["Strength"].default_value = (0.75, 0.85, 1.0, 1.0), 0.8
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy, sun.rotation_euler = 4.0, (math.radians(48), 0, math.radians(-38))
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type, camera.data.clip_end = "ORTHO", 500
    camera.data.ortho_scale = max(width * len(trees), 1.06 * height)
    camera.location = (width * len(trees) / 2, -80, 0.51 * height)
    camera.rotation_euler = (math.pi / 2, 0, 0)
    for thing in (sun, camera):
        scene.collection.objects.link(thing)
    scene.camera = camera
    bpy.ops.render.render(write_still=True)


def sheet(rows, path):
    """Two rows in each line, on the sky."""
    rows = [row.resize((WIDTH, round(row.height * WIDTH / row.width)), Image.LANCZOS) for row in rows]
    lines = [max(row.height for row in rows[i : i + 2]) for i in range(0, len(rows), 2)]
    whole = Image.new("RGB", (2 * WIDTH, sum(lines)), rows[0].getpixel((3, 3)))
    for i, row in enumerate(rows):
        whole.paste(row, (i % 2 * WIDTH, sum(lines[: i // 2 + 1]) - row.height))
    whole.quantize(96, dither=Image.Dither.NONE).save(path, optimize=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="pleach")
    parser.add_argument("out", type=Path)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        rows = []
        for species in SPECIES:
            path = Path(folder) / f"{species}.png"
            render(grow(given.program, species, Path(folder)), path)
            rows.append(Image.open(path).convert("RGB"))
        sheet(rows, given.out)


if __name__ == "__main__":
    main()
