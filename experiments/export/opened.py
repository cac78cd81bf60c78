"""Opens files of every kind in Blender and counts what arrived: `PYTHON experiments/export/opened.py OUT.csv FILE ...`.

PYTHON is Python 3.11 after `pip install bpy==4.5.15` or `bpy==5.0.1`. A file is called SPECIES-OPTIONS.glb, SPECIES.glb
or SPECIES.usda. Appends a row a file to OUT.csv, with a head where the file is new. `written` are the triangles that the
file says it has, instances counted each; `triangles` those that Blender has to draw, levels of detail and all.
"""

import csv
import json
import re
import struct
import sys
import time
from pathlib import Path

import bpy

COLUMNS = [
    "blender", "species", "options", "bytes", "opened", "objects", "written", "triangles", "materials", "images",
    "images_loaded", "levels_written", "levels", "wall_import_s",
]


def of_glb(path):
    """Triangles, pictures and levels of a GLB file."""
    with open(path, "rb") as file:
        (length,) = struct.unpack("<I", file.read(20)[12:16])
        content = json.loads(file.read(length))
    accessors, triangles, levels = content["accessors"], 0, 0
    for node in content["nodes"]:
        if "mesh" not in node:
            continue
        instancing = node.get("extensions", {}).get("EXT_mesh_gpu_instancing")
        times = accessors[instancing["attributes"]["TRANSLATION"]]["count"] if instancing else 1
        mesh = content["meshes"][node["mesh"]]["primitives"]
        triangles += times * sum(accessors[primitive["indices"]]["count"] // 3 for primitive in mesh)
        levels += bool(re.search(r"_LOD\d+$", node.get("name", "")))
    return triangles, len(content.get("images", [])), levels


def of_usda(path):
    """Triangles of a USDA file as pleach writes them, a property a line."""
    triangles, shapes, places = 0, None, []
    with open(path) as file:
        for line in file:
            line = line.strip()
            if line.startswith("def PointInstancer"):
                shapes = []
            elif line.startswith('def Scope'):
                shapes = None
            elif line.startswith("int[] protoIndices"):
                places = line[line.index("[", 6) + 1 : -1].split(", ")
            elif line.startswith("int[] faceVertexCounts"):
                faces = line[line.index("[", 6) + 1 : -1].count(",") + 1
                if shapes is None:
                    triangles += faces
                else:
                    triangles += faces * places.count(str(len(shapes)))
                    shapes.append(faces)
    return triangles, 0, 0


def drawn():
    """Triangles of everything that is in the scene, instances counted each."""
    known, triangles = {}, 0
    for thing in bpy.context.evaluated_depsgraph_get().object_instances:
        if thing.object.type != "MESH":
            continue
        mesh = thing.object.data
        key = mesh.as_pointer()
        if key not in known:
            mesh.calc_loop_triangles()
            known[key] = len(mesh.loop_triangles)
        triangles += known[key]
    return triangles


def row(path):
    """Imports a file into an empty scene; returns its row."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    species, _, options = path.stem.partition("-")
    glb = path.suffix == ".glb"
    options = (options or "default") if glb else "usda"
    written, images, levels = (of_glb if glb else of_usda)(path)
    start = time.perf_counter()
    try:
        if glb:
            bpy.ops.import_scene.gltf(filepath=str(path))
        else:
            bpy.ops.wm.usd_import(filepath=str(path))
        opened = "yes"
    except RuntimeError as error:
        opened = str(error).strip().splitlines()[-1]
    seconds = time.perf_counter() - start
    things = list(bpy.context.scene.objects)
    meshes = [thing for thing in things if thing.type == "MESH"]
    materials = {slot.material.name for thing in meshes for slot in thing.material_slots if slot.material}
    # A picture is read when its size is asked for.
    loaded = sum(min(image.size) > 0 and image.has_data for image in bpy.data.images)
    named = {thing.name for thing in meshes if re.search(r"_LOD\d+$", thing.name)}
    return [
        bpy.app.version_string.split()[0], species, options, path.stat().st_size, opened, len(things), written, drawn(),
        " ".join(sorted(materials)), images, loaded, levels, len(named), f"{seconds:.2f}",
    ]


def main():
    out, *files = [Path(name) for name in sys.argv[1:]]
    new = not out.exists()
    with open(out, "a", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        if new:
            writer.writerow(COLUMNS)
        for path in files:
            writer.writerow(row(path))
            file.flush()


if __name__ == "__main__":
    main()
