"""Sliders, dice and blends."""

from __future__ import annotations

import unittest
from typing import Any

import scene  # noqa: I001 # sets where Blender keeps settings, before bpy is loaded
import bpy


def setUpModule() -> None:
    scene.install()


def pleach() -> Any:
    return scene.module("library").pleach


class Sliding(unittest.TestCase):
    def setUp(self) -> None:
        scene.empty()

    def sliders(self, thing: Any) -> tuple[Any, Any]:
        species = scene.module("library").species_of(thing.pleach.species_text)
        space = scene.module("sliders").space_of(species)
        return getattr(thing, space.attribute), space

    def test_sliders_are_as_declared(self) -> None:
        thing = scene.grow("acer")
        group, space = self.sliders(thing)
        species = pleach().species("acer")
        self.assertEqual([slider.key for slider in space.sliders], species.slots)
        declared = species.declared("g_scale")
        prop = group.bl_rna.properties["g_scale"]
        low, high = declared["slots"][0]["search"]
        self.assertAlmostEqual(prop.soft_min, low, 5)
        self.assertAlmostEqual(prop.soft_max, high, 4)
        self.assertAlmostEqual(prop.hard_max, declared["max"], 3)
        self.assertIn(declared["doc"], prop.description)
        self.assertEqual(group.shape, species["shape"])
        for name in pleach().generators():
            family = next(one for one in pleach().species() if pleach().species(one).generator == name)
            _, other = self.sliders(scene.grow(family))
            first = [slider.handle for slider in scene.module("sliders").first_of(other)]
            self.assertEqual(first[:1], [] if name == "lsystem" else ["Height"], name)
            self.assertEqual(len(first), len(set(first)), name)

    def test_a_slider_grows_the_tree_again(self) -> None:
        thing = scene.grow("acer")
        group, _ = self.sliders(thing)
        height = scene.attribute(thing.data, "position", width=3)[:, 2].max()
        group.g_scale = 2 * group.g_scale
        self.assertGreater(scene.attribute(thing.data, "position", width=3)[:, 2].max(), 1.5 * height)
        species = scene.module("library").species_of(thing.pleach.species_text)
        self.assertAlmostEqual(species["g_scale"], group.g_scale, 4)
        unchanged = pleach().species("acer").replace(g_scale=species["g_scale"])
        self.assertEqual({key: species[key] for key in species}, {key: unchanged[key] for key in unchanged}, "and nothing else")

    def test_what_does_not_grow_leaves_the_tree(self) -> None:
        thing = scene.grow("quaking_aspen")
        group, _ = self.sliders(thing)
        before = thing.pleach.stem_count
        group.branches_1, group.branches_2 = 500, 500
        group.branches_3 = 500
        group.levels = 4
        problem = scene.module("state").problems[thing.session_uid]
        self.assertIn("branches", problem)
        self.assertGreaterEqual(thing.pleach.stem_count, before)
        bpy.ops.pleach.reset()
        self.assertEqual(thing.pleach.stem_count, before)
        self.assertNotIn(thing.session_uid, scene.module("state").problems)

    def test_dice_and_locks(self) -> None:
        thing = scene.grow("acer")
        group, _ = self.sliders(thing)
        bpy.ops.pleach.lock(key="g_scale")
        scale, ratio = group.g_scale, group.ratio
        bpy.ops.pleach.dice()
        self.assertEqual(group.g_scale, scale)
        self.assertNotEqual(group.ratio, ratio)
        bpy.ops.pleach.lock(key="g_scale")
        bpy.ops.pleach.dice()
        self.assertNotEqual(group.g_scale, scale)
        bpy.ops.pleach.reset()
        self.assertEqual((group.g_scale, group.ratio), (scale, ratio))
        seed = thing.pleach.seed
        bpy.ops.pleach.seed()
        self.assertNotEqual(thing.pleach.seed, seed)

    def test_blends_and_other_species(self) -> None:
        thing = scene.grow("quaking_aspen")
        bpy.context.scene.pleach.blend_with = "silver_birch"
        bpy.context.scene.pleach.blend = 0.5
        bpy.ops.pleach.blend()
        species = scene.module("library").species_of(thing.pleach.species_text)
        ends = [pleach().species(name)["g_scale"] for name in ("quaking_aspen", "silver_birch")]
        self.assertTrue(min(ends) < species["g_scale"] < max(ends))
        bpy.context.scene.pleach.blend_with = "stylised_oak"
        with self.assertRaisesRegex(RuntimeError, "generator"):
            bpy.ops.pleach.blend()
        bpy.ops.pleach.become(species="stylised_oak")
        self.assertEqual(thing.pleach.species_name, "stylised_oak")
        self.assertEqual(scene.counts(thing)["leaves"], 0)
        self.assertGreater(scene.counts(thing)["foliage"], 0)
