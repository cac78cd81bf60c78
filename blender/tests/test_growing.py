"""What grows, against the library's trees."""

from __future__ import annotations

import os
import unittest
from typing import Any

import scene  # noqa: I001 # sets where Blender keeps settings, before bpy is loaded
import bpy
import numpy as np

#: One of each family; all of them in the nightly run.
FIVE = ("quaking_aspen", "stylised_oak", "field_maple", "coffey_pine", "leafy_oak")


def setUpModule() -> None:
    scene.install()


def pleach() -> Any:
    return scene.module("library").pleach


class Installing(unittest.TestCase):
    def test_blender_takes_the_zip(self) -> None:
        self.assertIn("Success", scene.validate())


class Growing(unittest.TestCase):
    def setUp(self) -> None:
        scene.empty()

    def test_each_species_has_the_foliage_of_its_tree(self) -> None:
        names = pleach().species() if os.environ.get("PLEACH_ALL") else FIVE
        for name in names:
            with self.subTest(name):
                scene.empty()
                thing = scene.grow(name)
                tree = pleach().species(name).grow()
                found = scene.counts(thing)
                palette = tree.species.palette()
                leaves = len(tree.leaf_positions) if palette["leaves"] else 0
                self.assertEqual(found["leaves"], leaves)
                self.assertEqual(found["blossom"], len(tree.blossom_positions) if palette["blossoms"] else 0)
                self.assertEqual(found["foliage"], len(tree.blob_triangles) if palette["leaves"] else 0)
                roots = tree.kinds.count("root")
                self.assertEqual(len(thing.data.curves), len(tree.levels) - roots)
                self.assertEqual(thing.pleach.leaf_count, found["leaves"] + found["blossom"])
                self.assertGreater(found["bark"], 0)

    def test_curves_are_those_of_the_tree(self) -> None:
        thing = scene.grow("acer")
        tree = pleach().species("acer").grow()
        position = scene.attribute(thing.data, "position", width=3)
        self.assertTrue(np.allclose(position, tree.knots, atol=1e-5))
        self.assertTrue(np.allclose(scene.attribute(thing.data, "handle_right", width=3), tree.handles_out, atol=1e-5))
        self.assertTrue(np.allclose(scene.attribute(thing.data, "radius"), tree.radii, atol=1e-6))
        self.assertTrue((scene.attribute(thing.data, "parent", np.int32) == tree.parents).all())
        self.assertTrue((scene.attribute(thing.data, "level", np.int32) == tree.levels).all())
        # Bark is as thick as the tree: the lowest ring of the mesh around the first knot.
        bark = scene.bark_of(thing)
        foot = np.linalg.norm(bark[bark[:, 2] < 1e-3][:, :2] - tree.knots[0, :2], axis=1)
        self.assertAlmostEqual(float(foot.max()), float(tree.radii[0]), delta=0.02 * tree.radii[0])

    def test_leaves_stand_where_the_library_says(self) -> None:
        thing = scene.grow("acer")
        tree = pleach().species("acer").grow()
        wanted = np.sort(tree.mesh(tolerance=50.0).levels[0]["leaves"].positions[:, 2])
        heights: list[Any] = []
        for instance in bpy.context.evaluated_depsgraph_get().object_instances:
            if instance.is_instance and instance.parent.name.endswith("leaves"):
                mesh, matrix = instance.object.data, np.array(instance.matrix_world)
                corners = np.empty(len(mesh.vertices) * 3, np.float32)
                mesh.vertices.foreach_get("co", corners)
                heights.append((corners.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3])[:, 2])
        found = np.sort(np.concatenate(heights))
        self.assertEqual(len(found), len(wanted))
        self.assertLess(float(np.abs(found - wanted).max()), 1e-3)

    def test_a_share_of_the_leaves_is_shown(self) -> None:
        thing = scene.grow("quaking_aspen")
        whole = scene.counts(thing)["leaves"]
        thing.pleach.leaf_share = 0.1
        self.assertAlmostEqual(scene.counts(thing)["leaves"] / whole, 0.1, delta=0.005)
        thing.pleach.leaf_share = 0.0
        self.assertEqual(scene.counts(thing)["leaves"], 0)

    def test_seasons(self) -> None:
        thing = scene.grow("acer")
        leaves = scene.module("result").child(thing, "leaves")
        modifier = leaves.modifiers[0]
        shape = scene.module("nodes").get_input(modifier, "Shapes").objects[0]
        color = lambda: tuple(shape.material_slots[0].material.node_tree.nodes["pleach color"].outputs[0].default_value)  # noqa: E731
        summer = color()
        thing.pleach.season = "AUTUMN"
        self.assertNotEqual(color(), summer)
        thing.pleach.season = "WINTER"
        self.assertEqual(scene.counts(thing)["leaves"], 0)
        thing.pleach.season = "SUMMER"
        self.assertGreater(scene.counts(thing)["leaves"], 1000)

    def test_blossoms_and_roots(self) -> None:
        cherry = scene.grow("hill_cherry")
        self.assertGreater(scene.counts(cherry)["blossom"], 100)
        cherry.pleach.season = "AUTUMN"
        self.assertEqual(scene.counts(cherry)["blossom"], 0)
        oak = scene.grow("shallow_root_oak")
        stems = len(oak.data.curves)
        oak.pleach.roots = True
        self.assertGreater(len(oak.data.curves), stems)
        self.assertLess(scene.attribute(oak.data, "position", width=3)[:, 2].min(), -0.1)

    def test_bark_as_a_mesh_with_pictures(self) -> None:
        thing = scene.grow("palm")
        thing.pleach.textures = "512"
        thing.pleach.bark = "MESH"
        found = scene.counts(thing)
        bark = scene.module("result").child(thing, "bark")
        self.assertEqual(found["bark"], len(bark.data.polygons))
        images = [node.image for node in bark.data.materials[0].node_tree.nodes if node.type == "TEX_IMAGE"]
        self.assertEqual(len(images), 3)
        self.assertTrue(all(image.packed_file and tuple(image.size) == (512, 512) for image in images))
        # A picture on Blender's bark stands upright: v rises with height on the trunk.
        uv = scene.attribute(bark.data, "UVMap", width=2)
        order = np.empty(len(bark.data.loops), np.int32)
        bark.data.loops.foreach_get("vertex_index", order)
        positions = scene.attribute(bark.data, "position", width=3)[order]
        trunk = positions[:, 2] < 0.3 * positions[:, 2].max()
        self.assertGreater(np.corrcoef(uv[trunk, 1], positions[trunk, 2])[0, 1], 0.9)
        thing.pleach.bark = "CURVES"
        self.assertIsNone(scene.module("result").child(thing, "bark"))
        self.assertGreater(scene.counts(thing)["bark"], 0)
