"""Makes the pictures of docs/blender.md with Cycles: `PLEACH_ZIP=… python pictures.py OUT`, in Blender 5.

With names after OUT, such as `wind`, it makes these alone.
"""

from __future__ import annotations

import math
import pathlib
import sys
from typing import Any

import scene  # noqa: I001 # sets where Blender keeps settings, before bpy is loaded
import bmesh
import bpy

#: Metres between two trees.
GAP = 0.8


def row(things: list[Any], bounds: list[Any]) -> float:
    """Stands objects side by side; returns how wide they are together."""
    x = 0.0
    for thing, (low, high) in zip(things, bounds):
        scale = thing.scale[0]
        thing.location.x = x - low[0] * scale + GAP / 2
        x += (high[0] - low[0]) * scale + GAP
    return x


def species() -> tuple[float, float]:
    """A tree of each family that has leaves or blossom, all ten metres high."""
    library = scene.module("library").pleach
    names = ("quaking_aspen", "stylised_oak", "field_maple", "coffey_pine", "leafy_oak", "hill_cherry")
    bounds = [library.species(name).grow().bounds for name in names]
    things = [scene.grow(name) for name in names]
    for thing, (_, high) in zip(things, bounds):
        thing.scale = (10 / high[2],) * 3
    return row(things, bounds), 10.0


def acer() -> tuple[float, float]:
    """One tree in three seasons, and with leaves that are orange balls."""
    bounds = scene.module("library").pleach.species("acer").grow().bounds
    things = [scene.grow("acer") for _ in range(4)]
    things[1].pleach.season, things[2].pleach.season = "AUTUMN", "WINTER"
    leaves = scene.module("result").child(things[3], "leaves")
    shapes = scene.module("nodes").get_input(leaves.modifiers[0], "Shapes")
    for leaf in list(shapes.objects):
        shapes.objects.unlink(leaf)
    ball = bpy.data.meshes.new("ball")
    sphere = bmesh.new()
    bmesh.ops.create_icosphere(sphere, subdivisions=1, radius=0.5)
    sphere.to_mesh(ball)
    ball.materials.append(material("orange", (1.0, 0.18, 0.02)))
    shapes.objects.link(bpy.data.objects.new("ball", ball))
    return row(things, [bounds] * 4), float(bounds[1, 2])


def levels() -> tuple[float, float]:
    """A tree and its baked levels."""
    bounds = scene.module("library").pleach.species("quaking_aspen").grow().bounds
    tree = scene.grow("quaking_aspen")
    bpy.ops.pleach.bake()
    baked = [bpy.data.objects[f"quaking_aspen_LOD{level}"] for level in range(3)]
    for one in baked:
        one.hide_render = False
    return row([tree, *baked], [bounds] * 4), float(bounds[1, 2])


def wind() -> tuple[float, float]:
    """A birch in still air, in a fresh breeze and in one three times as strong."""
    bounds = scene.module("library").pleach.species("silver_birch").grow().bounds
    things = [scene.grow("silver_birch") for _ in range(3)]
    for thing, strength in zip(things[1:], (1.0, 3.0)):
        thing.pleach.wind = True
        scene.module("nodes").set_input(thing.modifiers["pleach wind"], "Strength", strength)
    bpy.context.scene.frame_set(42)
    # They lean out of their own width.
    return row(things, [bounds] * 3) + GAP, float(bounds[1, 2])


def map_picture(path: pathlib.Path) -> None:
    """The image of the map, as it is."""
    path.write_bytes(scene.module("plane").of_species().picture())


def material(name: str, color: tuple[float, float, float]) -> Any:
    made = bpy.data.materials.new(name)
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*color, 1.0)
    shader.inputs["Roughness"].default_value = 1.0
    return made


def render(path: pathlib.Path, wide: float, high: float) -> None:
    """Renders what stands in the scene, from the front and a little from above."""
    view = bpy.context.scene
    view.render.engine = "CYCLES"
    view.cycles.samples, view.cycles.use_denoising, view.cycles.transparent_max_bounces = 16, True, 32
    view.render.resolution_x, view.render.resolution_y = 1200, round(1200 * (1.15 * high + 0.6) / wide)
    view.render.filepath = str(path)
    view.view_settings.view_transform = "Standard"
    view.world = bpy.data.worlds.new("sky")
    sky = view.world.node_tree.nodes["Background"]
    sky.inputs["Color"].default_value, sky.inputs["Strength"].default_value = (0.65, 0.78, 0.95, 1.0), 0.8
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy, sun.rotation_euler = 3.5, (math.radians(50), 0, math.radians(35))
    ground = bpy.data.meshes.new("ground")
    ground.from_pydata([(-99, -99, 0), (199, -99, 0), (199, 99, 0), (-99, 99, 0)], [], [(0, 1, 2, 3)])
    ground.materials.append(material("ground", (0.35, 0.4, 0.25)))
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", wide
    tilt = math.radians(6)
    camera.location = (wide / 2, -60 * math.cos(tilt), high / 2 + 60 * math.sin(tilt))
    camera.rotation_euler = (math.pi / 2 - tilt, 0, 0)
    for thing in (sun, camera, bpy.data.objects.new("ground", ground)):
        view.collection.objects.link(thing)
    view.camera = camera
    bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    scene.install()
    out, names = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:]
    for make in (species, acer, levels, wind):
        if not names or make.__name__ in names:
            scene.empty()
            size = make()
            render(out / f"blender-{make.__name__}.png", *size)
    if not names or "map" in names:
        map_picture(out / "blender-map.png")
