"""What a user has made stays."""

from __future__ import annotations

import os
import tempfile
import unittest
from typing import Any

import scene  # noqa: I001 # sets where Blender keeps settings, before bpy is loaded
import bpy
import numpy as np


def setUpModule() -> None:
    scene.install()


def pleach() -> Any:
    return scene.module("library").pleach


class Keeping(unittest.TestCase):
    """What a user has made stays."""

    def setUp(self) -> None:
        scene.empty()

    def test_growing_again_keeps_materials_and_leaves(self) -> None:
        thing = scene.grow("acer")
        nodes, result = scene.module("nodes"), scene.module("result")
        mine = bpy.data.materials.new("mine")
        nodes.set_input(thing.modifiers[0], "Material", mine)
        leaves = result.child(thing, "leaves")
        shapes = nodes.get_input(leaves.modifiers[0], "Shapes")
        cube = bpy.data.objects.new("cube", bpy.data.meshes.new("cube"))
        for one in list(shapes.objects):
            shapes.objects.unlink(one)
        shapes.objects.link(cube)
        thing.pleach.seed += 1
        thing.pleach.season = "AUTUMN"
        self.assertIs(nodes.get_input(thing.modifiers[0], "Material"), mine)
        self.assertEqual(list(nodes.get_input(leaves.modifiers[0], "Shapes").objects), [cube])
        # Another collection altogether.
        other = bpy.data.collections.new("other")
        nodes.set_input(leaves.modifiers[0], "Shapes", other)
        thing.pleach.seed += 1
        self.assertEqual(nodes.get_input(leaves.modifiers[0], "Shapes"), other)
        self.assertEqual(list(other.objects), [])

    def test_a_changed_colour_stays(self) -> None:
        thing = scene.grow("acer")
        material = scene.module("nodes").get_input(thing.modifiers[0], "Material")
        node = material.node_tree.nodes["pleach color"]
        node.outputs[0].default_value = (1, 0, 0, 1)
        thing.pleach.seed += 1
        self.assertEqual(tuple(node.outputs[0].default_value), (1, 0, 0, 1))

    def test_growing_again_leaves_nothing_behind(self) -> None:
        thing = scene.grow("acer")
        blocks = ("objects", "meshes", "hair_curves", "materials", "node_groups", "collections", "images")
        count = lambda: {name: len(getattr(bpy.data, name)) for name in blocks}  # noqa: E731
        before = count()
        for seed in range(20, 25):
            thing.pleach.seed = seed
        self.assertEqual(count(), before)

    def test_edited_curves_move_the_bark(self) -> None:
        thing = scene.grow("acer")
        for name in ("position", "handle_left", "handle_right"):
            moved = scene.attribute(thing.data, name, width=3) + np.float32([5, 0, 0])
            thing.data.attributes[name].data.foreach_set("vector", moved.ravel())
        thing.data.update_tag()
        self.assertGreater(scene.bark_of(thing)[:, 0].mean(), 4)

    def test_undo_and_redo(self) -> None:
        bpy.ops.ed.undo_push(message="start")
        scene.grow("acer")
        bpy.ops.ed.undo_push(message="grow")
        name = bpy.context.active_object.name
        bpy.data.objects[name].pleach.seed = 7
        bpy.ops.ed.undo_push(message="seed")
        grown = scene.attribute(bpy.data.objects[name].data, "position", width=3)
        bpy.ops.ed.undo()
        self.assertEqual(bpy.data.objects[name].pleach.seed, 1)
        before = scene.attribute(bpy.data.objects[name].data, "position", width=3)
        self.assertFalse(before.shape == grown.shape and np.allclose(before, grown))
        bpy.ops.ed.redo()
        self.assertEqual(bpy.data.objects[name].pleach.seed, 7)
        self.assertTrue(np.array_equal(scene.attribute(bpy.data.objects[name].data, "position", width=3), grown))
        # It still grows.
        bpy.data.objects[name].pleach.seed = 8
        self.assertGreater(scene.counts(bpy.data.objects[name])["leaves"], 1000)

    def test_save_and_reload(self) -> None:
        thing = scene.grow("quaking_aspen")
        thing.pleach.season = "AUTUMN"
        bpy.ops.pleach.lock(key="ratio")
        group = getattr(thing, scene.module("sliders").space_of(pleach().species("quaking_aspen")).attribute)
        group.g_scale = 9.5
        before, bark, name = scene.counts(thing), scene.bark_of(thing), thing.name
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "tree.blend")
            bpy.ops.wm.save_as_mainfile(filepath=path)
            scene.empty()
            bpy.ops.wm.open_mainfile(filepath=path)
            thing = bpy.data.objects[name]
            self.assertEqual(scene.counts(thing), before)
            self.assertTrue(np.array_equal(scene.bark_of(thing), bark))
            self.assertEqual([lock.name for lock in thing.pleach.locks], ["ratio"])
            group = getattr(thing, scene.module("sliders").space_of(pleach().species("quaking_aspen")).attribute)
            self.assertAlmostEqual(group.g_scale, 9.5)
            group.g_scale = 9.0
            self.assertAlmostEqual(scene.module("library").species_of(thing.pleach.species_text)["g_scale"], 9.0)

    def test_a_file_of_a_newer_version(self) -> None:
        thing = scene.grow("acer")
        curves = len(thing.data.curves)
        thing.pleach.species_text = thing.pleach.species_text.replace("[parameters]", "[parameters]\nsap = 3", 1) + "\n[sap]\nflow = 1\n"
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "tree.blend")
            bpy.ops.wm.save_as_mainfile(filepath=path)
            bpy.ops.wm.open_mainfile(filepath=path)
        thing = next(one for one in bpy.data.objects if one.pleach.is_tree)
        self.assertIn("sap", scene.module("state").problems[thing.session_uid])
        thing.pleach.seed += 1
        self.assertEqual(len(thing.data.curves), curves, "the tree stays as it was")
