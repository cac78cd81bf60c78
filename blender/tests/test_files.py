"""Species files and baked meshes."""

from __future__ import annotations

import os
import pathlib
import tempfile
import unittest
from typing import Any

import scene  # noqa: I001 # sets where Blender keeps settings, before bpy is loaded
import bpy


def setUpModule() -> None:
    scene.install()


def pleach() -> Any:
    return scene.module("library").pleach


class Files(unittest.TestCase):
    def setUp(self) -> None:
        scene.empty()

    def test_species_files(self) -> None:
        thing = scene.grow("acer")
        thing.pleach.seed = 12
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "mine.toml")
            bpy.ops.pleach.save(filepath=path)
            self.assertEqual(pleach().species(path).tree_seed, 12)
            bpy.ops.pleach.load(filepath=path)
            other = bpy.context.active_object
            self.assertIsNot(other, thing)
            self.assertEqual(other.pleach.seed, 12)
            self.assertEqual(scene.counts(other), scene.counts(thing))
            pathlib.Path(path).write_text("name = 3\n")
            with self.assertRaisesRegex(RuntimeError, "mine.toml"):
                bpy.ops.pleach.load(filepath=path)
            with self.assertRaisesRegex(RuntimeError, "No such file|Not a directory"):
                bpy.ops.pleach.save(filepath=os.path.join(folder, "none", "mine.toml"))

    def test_bake(self) -> None:
        thing = scene.grow("acer")
        bpy.context.scene.pleach.budgets = "8000, 2000"
        bpy.ops.pleach.bake()
        baked = [bpy.data.objects[f"acer_LOD{level}"] for level in range(2)]
        for one, budget in zip(baked, (8000, 2000)):
            self.assertTrue(0.85 * budget <= len(one.data.polygons) <= budget)
            self.assertEqual(one.data.uv_layers.keys(), ["UVMap"])
            self.assertTrue(one.data.has_custom_normals)
            self.assertEqual([material.name.split()[1] for material in one.data.materials], ["bark", "twigs"])
        self.assertTrue(baked[1].hide_render and not baked[0].hide_render)
        bpy.context.scene.pleach.budgets = "a few"
        bpy.context.view_layer.objects.active = thing
        with self.assertRaisesRegex(RuntimeError, "whole numbers"):
            bpy.ops.pleach.bake()
