"""Wind, against the library's formula."""

from __future__ import annotations

import math
import os
import tempfile
import types
import unittest
from typing import Any

import scene  # noqa: I001 # sets where Blender keeps settings, before bpy is loaded
import bpy
import numpy as np
from test_panels import Layout

#: Five families, with leaves, blossom or foliage; all species in the nightly run.
SPECIES = ("quaking_aspen", "stylised_oak", "field_maple", "coffey_pine", "acer", "hill_cherry")
FRAMES = (8, 47, 186)
#: Metres: what moves by the formula itself, and what is between two points that do.
EXACT, NEAR = 2e-5, 1e-3


def setUpModule() -> None:
    scene.install()


def pleach() -> Any:
    return scene.module("library").pleach


class Moved:
    """A tree of the library in the wind of a frame."""

    def __init__(self, tree: Any, frame: int, strength: float = 1.0, direction: float = 0.0) -> None:
        self.tree, self.stems = tree, tree.wind()
        bpy.context.scene.frame_set(frame)
        render = bpy.context.scene.render
        wind = (strength * math.cos(direction), strength * math.sin(direction), 0.0)
        self.breeze = {"wind": wind, "time": frame * render.fps_base / render.fps, "height": float(tree.bounds[1, 2])}

    def __call__(self, positions: Any, stems: Any) -> Any:
        """Where these places are, each of which belongs to one of the stems."""
        return self.stems.take(stems.astype(np.int64)).moved(positions.astype(np.float32), **self.breeze)


def kept_stems(tree: Any) -> Any:
    return np.array([kind != "root" for kind in tree.kinds])


def moved_curves(thing: Any) -> tuple[Any, Any, Any]:
    """Points of the curves as they are in wind, without bark around them; the curve of each, and its place on the curve: 2.5
    between the third knot and the fourth."""
    curves = thing.data
    counts = np.array([len(curve.points) for curve in curves.curves])
    curves.attributes.new("place", "FLOAT", "POINT")
    places = np.concatenate([np.arange(count, dtype=np.float32) for count in counts])
    curves.attributes["place"].data.foreach_set("value", places)
    thing.modifiers["pleach bark"].show_viewport = False
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    positions, places = scene.attribute(evaluated, "position", width=3), scene.attribute(evaluated, "place")
    owner = np.repeat(np.arange(len(counts)), [len(curve.points) for curve in evaluated.curves])
    curves.attributes.remove(curves.attributes["place"])
    thing.modifiers["pleach bark"].show_viewport = True
    return positions, owner, places


def rest(tree: Any, stems: Any, places: Any) -> Any:
    """Where places of stems are in still air."""
    whole = np.minimum(np.floor(places), np.maximum(tree.knot_counts[stems] - 2, 0)).astype(int)
    first, t = tree.first_knots[stems] + whole, (places - whole)[:, None]
    after = np.minimum(first + 1, len(tree.knots) - 1)
    return ((1 - t) ** 3 * tree.knots[first] + 3 * (1 - t) ** 2 * t * tree.handles_out[first]
            + 3 * (1 - t) * t**2 * tree.handles_in[after] + t**3 * tree.knots[after])


def instances(child: Any) -> Any:
    """Where leaves stand and how they are turned: matrices of shape (leaves, 4, 4)."""
    all_instances = bpy.context.evaluated_depsgraph_get().object_instances
    return np.array([np.array(one.matrix_world) for one in all_instances if one.is_instance and one.parent.name == child.name])


def settings(thing: Any, strength: float, direction: float) -> None:
    nodes = scene.module("nodes")
    modifier = thing.modifiers["pleach wind"]
    nodes.set_input(modifier, "Strength", strength)
    nodes.set_input(modifier, "Direction", direction)


def child(thing: Any, kind: str) -> Any:
    return scene.module("result").child(thing, kind)


class Formula(unittest.TestCase):
    def setUp(self) -> None:
        scene.empty()

    def test_curves_bases_and_leaves_go_where_the_library_says(self) -> None:
        for name in pleach().species() if os.environ.get("PLEACH_ALL") else SPECIES:
            scene.empty()
            thing, tree = scene.grow(name), pleach().species(name).grow()
            thing.pleach.wind = True
            settings(thing, 1.2, 0.7)
            for frame in FRAMES:
                with self.subTest(name, frame=frame):
                    self.check(thing, tree, Moved(tree, frame, 1.2, 0.7))

    def check(self, thing: Any, tree: Any, moved: Moved) -> None:
        positions, owner, places = moved_curves(thing)
        stems = np.flatnonzero(kept_stems(tree))[owner]
        still = rest(tree, stems, places)
        self.assertLess(np.abs(positions - moved(still, stems)).max(), EXACT)
        self.assertGreater(np.linalg.norm(positions - still, axis=1).max(), 0.01)
        # What is carried between two points is where the formula takes the middle: bases of branches, and stalks.
        inner = owner[1:] == owner[:-1]
        middle, at = ((line[1:] + line[:-1])[inner] / 2 for line in (positions, still))
        self.assertLess(np.linalg.norm(middle - moved(at, stems[1:][inner]), axis=1).max(), NEAR)
        # The base of a branch goes where its parent would take it.
        first = np.flatnonzero(places == 0)
        parents = tree.parents[stems[first]]
        has_parent = parents >= 0
        bases = moved(still[first][has_parent], parents[has_parent])
        self.assertLess(np.linalg.norm(positions[first][has_parent] - bases, axis=1).max(initial=0), NEAR)
        for kind, at, carriers in (("leaves", tree.leaf_positions, tree.leaf_stems),
                                   ("blossom", tree.blossom_positions, tree.blossom_stems)):
            one = child(thing, kind)
            found = instances(one)[:, :3, 3] if one is not None and len(one.data.vertices) else np.empty((0, 3))
            if len(found):
                self.assertLess(np.abs(found - moved(at, carriers)).max(), EXACT)

    def test_bark_as_a_mesh_and_foliage(self) -> None:
        for name, kind in (("acer", "bark"), ("stylised_oak", "foliage")):
            thing, tree = scene.grow(name), pleach().species(name).grow()
            if kind == "bark":
                thing.pleach.bark = "MESH"
            thing.pleach.wind = True
            moved, one = Moved(tree, 60), child(thing, kind)
            evaluated = one.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
            found = scene.attribute(evaluated, "position", width=3)
            if kind == "bark":
                part = tree.mesh(leaves="none", tolerance=thing.pleach.tolerance, wind=True).levels[0]["bark"]
                wanted, at = part.wind.moved(part.positions, **moved.breeze), part.positions
            else:
                firsts, count = tree.blob_first_vertices, len(tree.blob_vertices)
                blobs = np.searchsorted(firsts, np.arange(count), side="right") - 1
                wanted, at = moved(tree.blob_vertices, tree.blob_stems[blobs]), tree.blob_vertices
            self.assertLess(np.abs(found - wanted).max(), EXACT)
            self.assertGreater(np.abs(found - at).max(), 0.01)

    def test_roots_stay_in_the_ground(self) -> None:
        thing, tree = scene.grow("shallow_root_oak"), pleach().species("shallow_root_oak").grow()
        thing.pleach.roots = True
        thing.pleach.wind = True
        moved = Moved(tree, 47)
        positions, stems, places = moved_curves(thing)
        still = rest(tree, stems, places)
        self.assertEqual(len(thing.data.curves), len(tree.levels))
        self.assertLess(np.abs(positions - moved(still, stems)).max(), EXACT)
        below = still[:, 2] < 0
        self.assertTrue(below.any() and np.abs(positions - still)[below].max() < EXACT)

    def test_leaves_turn_with_their_twigs_and_flutter(self) -> None:
        thing, tree = scene.grow("acer"), pleach().species("acer").grow()
        thing.pleach.wind = True
        still = instances(child(thing, "leaves"))
        stalks, tips = [], []
        for frame in (20, 23, 26):
            moved = Moved(tree, frame)
            found = instances(child(thing, "leaves"))
            # Their sizes stay.
            for axis, limit in ((0, 1e-5), (1, 0.02)):
                sizes = np.linalg.norm(found[:, :3, axis], axis=1) / np.linalg.norm(still[:, :3, axis], axis=1)
                self.assertLess(np.abs(sizes / np.median(sizes) - 1).max(), limit)
            stalks.append(found[:, :3, 3])
            tips.append(found[:, :3, 3] + found[:, :3, 1])
            wanted = tree.wind("leaves").moved(tree.leaf_positions + tree.leaf_along, **moved.breeze)
            self.assertLess(np.linalg.norm(tips[-1] - wanted, axis=1).max(), 0.08)
        beat = np.linalg.norm((tips[2] - stalks[2]) - (tips[0] - stalks[0]), axis=1)
        self.assertTrue(0.002 < np.median(beat) < 0.1, np.median(beat))

    def test_the_wind_is_that_of_the_scene(self) -> None:
        thing, tree = scene.grow("quaking_aspen"), pleach().species("quaking_aspen").grow()
        thing.pleach.wind = True
        thing.rotation_euler = (0, 0, 1.1)
        settings(thing, 1.0, 0.4)
        moved = Moved(tree, 50, 1.0, 0.4 - 1.1)
        positions, owner, places = moved_curves(thing)
        self.assertLess(np.abs(positions - moved(rest(tree, owner, places), owner)).max(), EXACT)
        # A tree further on has the same wind later.
        thing.rotation_euler = (0, 0, 0)
        settings(thing, 1.0, 0.0)
        thing.location.x = 4.0
        moved = Moved(tree, 62)
        moved.breeze["time"] = 50 / 24
        positions, owner, places = moved_curves(thing)
        self.assertLess(np.abs(positions - moved(rest(tree, owner, places), owner)).max(), EXACT)

    def test_nothing_jumps(self) -> None:
        for name in ("quaking_aspen", "stylised_oak", "leafy_oak", "coffey_pine"):
            scene.empty()
            thing = scene.grow(name)
            thing.pleach.wind = True
            last = None
            # Around the frame in which the tree is upright between two gusts.
            for frame in range(80, 92):
                bpy.context.scene.frame_set(frame)
                bark = scene.bark_of(thing)
                if last is not None:
                    self.assertEqual(len(bark), len(last))
                    self.assertLess(np.linalg.norm(bark - last, axis=1).max(), 0.06, f"{name}, frame {frame}")
                last = bark


class Settings(unittest.TestCase):
    def setUp(self) -> None:
        scene.empty()

    def test_growing_again_keeps_the_wind(self) -> None:
        thing = scene.grow("acer")
        thing.pleach.wind = True
        settings(thing, 0.5, 1.0)
        thing.pleach.seed = 9
        thing.pleach.bark = "MESH"
        bpy.ops.pleach.become(species="hill_cherry")
        nodes, modifier = scene.module("nodes"), thing.modifiers["pleach wind"]
        tree = pleach().species("hill_cherry").grow(9)
        self.assertEqual((nodes.get_input(modifier, "Strength"), nodes.get_input(modifier, "Direction")), (0.5, 1.0))
        self.assertAlmostEqual(nodes.get_input(modifier, "Height"), tree.bounds[1, 2], places=4)
        moved = Moved(tree, 30, 0.5, 1.0)
        self.assertLess(np.abs(instances(child(thing, "blossom"))[:, :3, 3] - moved(tree.blossom_positions, tree.blossom_stems)).max(), EXACT)
        self.assertEqual([one.modifiers[0].name for one in thing.children], ["pleach wind"] * 3)

    def test_still_air_again(self) -> None:
        thing = scene.grow("acer")
        thing.pleach.bark = "MESH"
        count = lambda: {name: len(getattr(bpy.data, name)) for name in ("objects", "meshes", "hair_curves", "materials")}  # noqa: E731
        before, attributes = count(), {one.name: set(one.data.attributes.keys()) for one in (thing, *thing.children)}
        bpy.context.scene.frame_set(40)
        still = instances(child(thing, "leaves"))
        thing.pleach.wind = True
        settings(thing, 2.0, 0.3)
        self.assertTrue(thing.pleach.wind)
        self.assertGreater(np.abs(instances(child(thing, "leaves")) - still).max(), 0.05)
        thing.pleach.wind = False
        self.assertFalse(thing.pleach.wind)
        self.assertTrue(np.array_equal(instances(child(thing, "leaves")), still))
        self.assertEqual(count(), before)
        for one in (thing, *thing.children):
            self.assertNotIn("pleach wind", one.modifiers)
            self.assertFalse(one.animation_data and len(one.animation_data.drivers))
            if one is not child(thing, "bark"):
                self.assertEqual(set(one.data.attributes.keys()), attributes[one.name])
        # The next wind is as the last one was.
        thing.pleach.wind = True
        nodes = scene.module("nodes")
        self.assertAlmostEqual(nodes.get_input(thing.modifiers["pleach wind"], "Strength"), 2.0)
        # A modifier that is taken away by hand is still air as well.
        thing.modifiers.remove(thing.modifiers["pleach wind"])
        self.assertFalse(thing.pleach.wind)

    def test_edits_of_curves_stay(self) -> None:
        thing = scene.grow("acer")
        for name in ("position", "handle_left", "handle_right"):
            shifted = scene.attribute(thing.data, name, width=3) * np.float32([1, 1, 1.5])
            thing.data.attributes[name].data.foreach_set("vector", shifted.ravel())
        before = scene.attribute(thing.data, "position", width=3)
        thing.pleach.wind = True
        self.assertTrue(np.array_equal(scene.attribute(thing.data, "position", width=3), before))
        bpy.context.scene.frame_set(33)
        positions, _, places = moved_curves(thing)
        knots = positions[places == np.floor(places)]
        self.assertGreater(np.abs(knots - before).max(), 0.01)
        self.assertLess(np.abs(knots - before).max(), 2.0)

    def test_all_parts_follow_the_modifier_of_the_tree_without_the_extension(self) -> None:
        import addon_utils

        thing = scene.grow("acer")
        thing.pleach.wind = True
        name = thing.name
        modifier = thing.modifiers["pleach wind"]
        path = f'modifiers["pleach wind"]["{scene.module("nodes").key_of(modifier, "Strength")}"]'
        key = scene.module("nodes").key_of(modifier, "Strength")
        # Animated: no wind in the first frame, much later on.
        for frame, strength in ((1, 0.0), (30, 2.0)):
            modifier[key] = strength
            thing.keyframe_insert(path, frame=frame)
        leaves = child(thing, "leaves").name
        tree = pleach().species("acer").grow()
        moved = Moved(tree, 30, 2.0)
        wanted = moved(tree.leaf_positions, tree.leaf_stems)
        addon_utils.disable(scene.MODULE, default_set=True)
        try:
            bpy.context.scene.frame_set(1)
            self.assertLess(np.abs(instances(bpy.data.objects[leaves])[:, :3, 3] - tree.leaf_positions).max(), EXACT)
            bpy.context.scene.frame_set(30)
            self.assertLess(np.abs(instances(bpy.data.objects[leaves])[:, :3, 3] - wanted).max(), EXACT)
        finally:
            addon_utils.enable(scene.MODULE, default_set=True)
        self.assertTrue(bpy.data.objects[name].pleach.wind)

    def test_curves_without_numbers_get_them_unless_they_were_edited(self) -> None:
        thing, state, data = scene.grow("acer"), scene.module("state"), scene.module("wind_data")
        data.drop_wind(thing.data)
        thing.data.remove_curves(indices=[len(thing.data.curves) - 1])
        thing.pleach.wind = True
        self.assertIn("press Grow Again", state.problems[thing.session_uid])
        self.assertFalse(thing.pleach.wind)
        bpy.ops.pleach.again()
        self.assertNotIn(thing.session_uid, state.problems)
        data.drop_wind(thing.data)
        thing.pleach.wind = True
        tree = pleach().species("acer").grow()
        moved = Moved(tree, 40)
        positions, owner, places = moved_curves(thing)
        self.assertLess(np.abs(positions - moved(rest(tree, owner, places), owner)).max(), EXACT)

    def test_a_copy_has_a_wind_of_its_own(self) -> None:
        thing = scene.grow("acer")
        thing.pleach.wind = True
        for one in thing.children:
            one.select_set(True)
        bpy.ops.object.duplicate()
        copy = next(one for one in bpy.data.objects if one.pleach.is_tree and one != thing)
        settings(copy, 0.0, 0.0)
        bpy.context.scene.frame_set(25)
        tree = pleach().species("acer").grow()
        self.assertLess(np.abs(instances(child(copy, "leaves"))[:, :3, 3] - tree.leaf_positions).max(), EXACT)
        self.assertGreater(np.abs(instances(child(thing, "leaves"))[:, :3, 3] - tree.leaf_positions).max(), 0.01)

    def test_a_linked_copy_keeps_its_wind_when_the_other_has_none(self) -> None:
        thing = scene.grow("acer")
        thing.pleach.wind = True
        for one in thing.children:
            one.select_set(True)
        bpy.ops.object.duplicate(linked=True)
        copy = next(one for one in bpy.data.objects if one.pleach.is_tree and one != thing)
        thing.pleach.wind = False
        bpy.context.scene.frame_set(25)
        tree = pleach().species("acer").grow()
        wanted = Moved(tree, 25)(tree.leaf_positions, tree.leaf_stems)
        self.assertLess(np.abs(instances(child(copy, "leaves"))[:, :3, 3] - wanted).max(), EXACT)

    def test_edited_leaves_say_so(self) -> None:
        thing, state = scene.grow("acer"), scene.module("state")
        child(thing, "leaves").data.vertices.add(3)
        thing.pleach.wind = True
        self.assertIn("press Grow Again", state.problems[thing.session_uid])
        self.assertFalse(thing.pleach.wind)
        self.assertTrue(all("pleach wind" not in one.modifiers for one in (thing, *thing.children)))

    def test_wind_where_there_is_some_keeps_it(self) -> None:
        thing = scene.grow("acer")
        thing.pleach.wind = True
        settings(thing, 2.0, 0.3)
        thing.pleach.wind = False
        thing.pleach.wind = True
        settings(thing, 0.7, 0.1)
        thing.pleach.wind = True
        self.assertAlmostEqual(scene.module("nodes").get_input(thing.modifiers["pleach wind"], "Strength"), 0.7, places=5)

    def test_one_wind_for_selected_trees(self) -> None:
        trees = [scene.grow("acer") for _ in range(3)]
        nodes = scene.module("nodes")
        trees[2].pleach.wind = True
        settings(trees[2], 1.4, 0.6)
        self.assertEqual(bpy.ops.pleach.same_wind(), {"CANCELLED"}, "there is no other")
        child(trees[0], "leaves").select_set(True)
        bpy.ops.pleach.same_wind()
        self.assertEqual([tree.pleach.wind for tree in trees], [True, False, True])
        self.assertAlmostEqual(nodes.get_input(trees[0].modifiers["pleach wind"], "Direction"), 0.6, places=5)
        self.assertAlmostEqual(nodes.get_input(trees[0].modifiers["pleach wind"], "Strength"), 1.4, places=5)
        trees[2].pleach.wind = False
        bpy.ops.pleach.same_wind()
        self.assertFalse(trees[0].pleach.wind)

    def test_the_panel_has_the_settings_of_the_modifier(self) -> None:
        thing, panel = scene.grow("acer"), scene.module("panel").PLEACH_PT_wind

        def drawn() -> list[str]:
            layout = Layout()
            for draw in (panel.draw_header, panel.draw):
                draw(types.SimpleNamespace(layout=layout), bpy.context)
            return layout.shown

        self.assertEqual(drawn(), ["wind", "The air is still"])
        thing.pleach.wind = True
        self.assertEqual(drawn(), ["wind", "Strength", "Direction", "pleach.same_wind"])
        bpy.context.view_layer.objects.active = child(thing, "leaves")
        self.assertEqual(drawn(), ["wind", "Strength", "Direction", "pleach.same_wind"])

    def test_undo_save_and_reload(self) -> None:
        thing = scene.grow("acer")
        name = thing.name
        bpy.ops.ed.undo_push(message="grow")
        thing.pleach.wind = True
        settings(thing, 1.5, 0.2)
        bpy.ops.ed.undo_push(message="wind")
        bpy.ops.ed.undo()
        self.assertFalse(bpy.data.objects[name].pleach.wind)
        self.assertTrue(all("pleach wind" not in one.modifiers for one in bpy.data.objects[name].children))
        bpy.ops.ed.redo()
        thing = bpy.data.objects[name]
        self.assertTrue(thing.pleach.wind)
        bpy.context.scene.frame_set(71)
        before = instances(child(thing, "leaves"))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "tree.blend")
            bpy.ops.wm.save_as_mainfile(filepath=path)
            scene.empty()
            bpy.ops.wm.open_mainfile(filepath=path)
        thing = bpy.data.objects[name]
        self.assertTrue(np.array_equal(instances(child(thing, "leaves")), before))
        settings(thing, 0.0, 0.2)
        bpy.context.scene.frame_set(72)
        tree = pleach().species("acer").grow()
        self.assertLess(np.abs(instances(child(thing, "leaves"))[:, :3, 3] - tree.leaf_positions).max(), EXACT)

    def test_baked_levels_move(self) -> None:
        thing = scene.grow("acer")
        bpy.context.scene.pleach.budgets = "8000, 2000"
        thing.pleach.wind = True
        settings(thing, 1.0, 0.9)
        bpy.ops.pleach.bake()
        tree = pleach().species("acer").grow()
        made = tree.mesh(triangles=[8000, 2000], textures=1024, wind=True)
        for level in range(2):
            baked = bpy.data.objects[f"acer_LOD{level}"]
            moved = Moved(tree, 44, 1.0, 0.9)
            baked.hide_set(False)
            found = scene.attribute(baked.evaluated_get(bpy.context.evaluated_depsgraph_get()).data, "position", width=3)
            bark = made.levels[level]["bark"]
            wanted = bark.wind.moved(bark.positions, **moved.breeze)
            self.assertLess(np.abs(found[: len(wanted)] - wanted).max(), EXACT)
        self.assertFalse(baked.animation_data, "a baked level is by itself")
