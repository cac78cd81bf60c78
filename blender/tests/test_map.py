"""The map of species, and blends."""

from __future__ import annotations

import os
import tempfile
import types
import unittest
from typing import Any

import scene  # noqa: I001 # sets where Blender keeps settings, before bpy is loaded
import bpy
from test_panels import Layout


def setUpModule() -> None:
    scene.install()


def pleach() -> Any:
    return scene.module("library").pleach


def species_of(thing: Any) -> Any:
    return scene.module("library").species_of(thing.pleach.species_text)


def place_of(name: str) -> tuple[float, float]:
    plane = pleach().Map()
    x, y = plane.points[plane.names.index(name)]
    return float(x), float(y)


class Maps(unittest.TestCase):
    def setUp(self) -> None:
        scene.empty()

    def test_the_image_shows_species_where_a_click_finds_them(self) -> None:
        self.assertEqual(bpy.ops.pleach.map(), {"FINISHED"})
        image, plane = bpy.data.images["pleach map"], scene.module("plane")
        width, height = image.size
        self.assertTrue(image.packed_file and width > 1000 and height > 700)
        pixels = image.pixels[:]
        for name, point in zip(plane.of_species().names, plane.of_species().points):
            column, row = plane.of_species().pixel_at(*point)
            # A dark dot; rows of images count from the foot.
            first = 4 * (int(height - 1 - row) * width + int(column))
            self.assertLess(sum(pixels[first : first + 3]), 1.5, name)
            found = plane.point_at(column / width, 1 - row / height)
            self.assertAlmostEqual(found[0], point[0], places=5)
            self.assertAlmostEqual(found[1], point[1], places=5)
        self.assertIsNone(plane.point_at(0.01, 0.5), "beside the frame")
        # It is made once.
        bpy.ops.pleach.map()
        self.assertEqual([one.name for one in bpy.data.images if one.name.startswith("pleach map")], ["pleach map"])

    def test_a_point_is_grown_and_turns_the_active_tree_into_its_own(self) -> None:
        x, y = place_of("palm")
        self.assertEqual(bpy.ops.pleach.map_go(x=x, y=y), {"FINISHED"})
        thing = bpy.context.active_object
        palm = pleach().species("palm").grow(thing.pleach.seed)
        self.assertEqual(scene.counts(thing)["leaves"], len(palm.leaf_positions))
        mine = bpy.data.materials.new("mine")
        scene.module("nodes").set_input(thing.modifiers["pleach bark"], "Material", mine)
        self.assertEqual(thing.pleach.species_name, "palm")
        count = len(bpy.data.objects)
        x, y = place_of("acer")
        bpy.ops.pleach.map_go(x=x, y=y)
        self.assertIs(bpy.context.active_object, thing)
        self.assertEqual(len(bpy.data.objects), count)
        self.assertEqual(len(thing.data.curves), len(pleach().species("acer").grow(thing.pleach.seed).levels))
        self.assertIs(scene.module("nodes").get_input(thing.modifiers["pleach bark"], "Material"), mine)
        bpy.ops.pleach.map_go(x=x, y=y, new=True)
        self.assertIsNot(bpy.context.active_object, thing)
        # A tree of another family becomes one of the map.
        oak = scene.grow("leafy_oak")
        bpy.ops.pleach.map_go(x=x, y=y)
        self.assertEqual(species_of(oak).generator, "weber-penn")
        # Between species it is called after the two that it has most of.
        (ax, ay), (bx, by) = place_of("acer"), place_of("bamboo")
        x, y = (2 * ax + bx) / 3, (2 * ay + by) / 3
        bpy.ops.pleach.map_go(x=x, y=y)
        self.assertEqual(oak.pleach.species_name, "acer_bamboo")
        # Its own numbers belong elsewhere, since two axes hold a third of what makes a species.
        self.assertGreater(abs(scene.module("plane").locate(species_of(oak))[0] - x), 0.001)
        self.assertAlmostEqual(oak.pleach.map_x, x, places=5)
        oak.pleach.map_y = y + 0.1
        self.assertAlmostEqual(oak.pleach.map_x, x, places=5)
        self.assertAlmostEqual(oak.pleach.map_y, y + 0.1, places=5)

    def test_sliders_of_the_place(self) -> None:
        thing = scene.grow("acer")
        state = thing.pleach
        for found, wanted in zip((state.map_x, state.map_y), place_of("acer")):
            self.assertAlmostEqual(found, wanted, places=4)
        x, y = place_of("silver_birch")
        state.map_x, state.map_y = x, y
        self.assertAlmostEqual(species_of(thing)["g_scale"], pleach().species("silver_birch")["g_scale"], places=5)
        self.assertAlmostEqual(state.map_x, x, places=5)
        text = state.species_text
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "tree.blend")
            bpy.ops.pleach.map()
            bpy.ops.wm.save_as_mainfile(filepath=path)
            scene.empty()
            bpy.ops.wm.open_mainfile(filepath=path)
        thing = next(one for one in bpy.data.objects if one.pleach.is_tree)
        self.assertAlmostEqual(thing.pleach.map_y, y, places=5)
        self.assertEqual(thing.pleach.species_text, text)

    def test_clicks_are_on_the_picture_and_not_on_a_sidebar(self) -> None:
        view = types.SimpleNamespace(region_to_view=lambda x, y: (x / 400, y / 300))
        window = types.SimpleNamespace(type="WINDOW", x=100, y=50, width=500, height=400, view2d=view)
        sidebar = types.SimpleNamespace(type="UI", x=450, y=50, width=150, height=400)
        area = types.SimpleNamespace(regions=[sidebar, window])
        click_at = scene.module("map_operators").click_at
        self.assertEqual(click_at(area, 300, 200), (0.5, 0.5))
        self.assertIsNone(click_at(area, 460, 200), "on the sidebar")
        self.assertIsNone(click_at(area, 300, 400), "above the picture")
        self.assertIsNone(click_at(area, 50, 60), "in another area")
        sidebar.width = 1
        self.assertEqual(click_at(area, 460, 200), (0.9, 0.5))

    def test_each_click_is_a_tree_until_it_is_ended(self) -> None:
        kind, plane = scene.module("map_operators").PLEACH_OT_map_click, scene.module("plane")
        width, height = plane.image().size
        view = types.SimpleNamespace(region_to_view=lambda x, y: (x / width, y / height))
        window = types.SimpleNamespace(type="WINDOW", x=0, y=0, width=width, height=height, view2d=view)
        said: list[str] = []
        operator = types.SimpleNamespace(area=types.SimpleNamespace(regions=[window]), new=False, _is_open=lambda _: True,
                                         cancel=lambda _: said.append("ended"), report=lambda _, words: said.append(words))

        def event(kind_of: str, x: float = 0, y: float = 0) -> set[str]:
            happened = types.SimpleNamespace(type=kind_of, value="PRESS", mouse_x=x, mouse_y=y)
            return kind.modal(operator, bpy.context, happened)

        for name in ("palm", "acer"):
            column, row = plane.of_species().pixel_at(*place_of(name))
            self.assertEqual(event("LEFTMOUSE", column, height - row), {"RUNNING_MODAL"})
            self.assertIn(name, bpy.context.active_object.pleach.species_name)
        self.assertEqual(len([one for one in bpy.data.objects if one.pleach.is_tree]), 1)
        self.assertEqual(event("LEFTMOUSE", 5, 300), {"RUNNING_MODAL"})
        self.assertEqual(said, ["Click inside the frame of the map"])
        self.assertEqual(event("MIDDLEMOUSE", 500, 300), {"PASS_THROUGH"}, "one may move the view")
        self.assertEqual(event("ESC"), {"FINISHED"})
        self.assertEqual(said[1:], ["ended"])

    def test_panels(self) -> None:
        panel = scene.module("map_panel")

        def drawn(kind: Any, **context: Any) -> list[str]:
            layout = Layout()
            given = types.SimpleNamespace(scene=bpy.context.scene, active_object=bpy.context.active_object, **context)
            kind.draw(types.SimpleNamespace(layout=layout), given)
            return layout.shown

        self.assertEqual(drawn(panel.PLEACH_PT_map), ["pleach.map"])
        scene.grow("acer")
        self.assertEqual(drawn(panel.PLEACH_PT_map), ["pleach.map", "map_x", "map_y"])
        nothing, bpy_map = types.SimpleNamespace(image=None), types.SimpleNamespace(image=scene.module("plane").image())
        self.assertEqual(drawn(panel.PLEACH_PT_map_image, space_data=nothing), ["pleach.map"])
        self.assertEqual(drawn(panel.PLEACH_PT_map_image, space_data=bpy_map), ["pleach.map_click"] * 2 + ["map_x", "map_y"])
        scene.grow("leafy_oak")
        self.assertIn("is not of the family of the map, weber-penn", " ".join(drawn(panel.PLEACH_PT_map)))
        self.assertFalse(bpy.ops.pleach.map_click.poll(), "there is no Image Editor")


class Blends(unittest.TestCase):
    def setUp(self) -> None:
        scene.empty()

    def test_between_two_species(self) -> None:
        panel = bpy.context.scene.pleach
        panel.blend_with = "palm"
        with self.assertRaisesRegex(RuntimeError, "select one, or choose a species"):
            bpy.ops.pleach.blend()
        panel.blend_from, panel.blend = "quaking_aspen", 0.25
        bpy.ops.pleach.blend()
        thing = bpy.context.active_object
        wanted = pleach().blend({"quaking_aspen": 0.75, "palm": 0.25})
        self.assertAlmostEqual(species_of(thing)["g_scale"], wanted["g_scale"])
        # Again from the two, and not from what came of them.
        panel.blend = 0.75
        bpy.ops.pleach.blend()
        self.assertIs(bpy.context.active_object, thing)
        wanted = pleach().blend({"quaking_aspen": 0.25, "palm": 0.75})
        self.assertAlmostEqual(species_of(thing)["g_scale"], wanted["g_scale"])

    def test_the_active_tree_and_its_own_species(self) -> None:
        thing = scene.grow("acer")
        group = getattr(thing, scene.module("sliders").space_of(pleach().species("acer")).attribute)
        before = group.g_scale
        group.g_scale = before + 4
        panel = bpy.context.scene.pleach
        panel.blend_with, panel.blend = "acer", 0.5
        bpy.ops.pleach.blend()
        self.assertTrue(before + 1.5 < group.g_scale < before + 2.5)

    def test_a_species_and_itself_are_the_species(self) -> None:
        panel = bpy.context.scene.pleach
        panel.blend_from = panel.blend_with = "acer"
        panel.blend = 0.0
        self.assertEqual(bpy.ops.pleach.blend(), {"FINISHED"})
        self.assertEqual(species_of(bpy.context.active_object)["g_scale"], pleach().species("acer")["g_scale"])

    def test_panels_say_that_a_text_cannot_be_read(self) -> None:
        thing = scene.grow("acer")
        thing.pleach.species_text = "levels = 99"
        for module, kind in (("panel", "PLEACH_PT_blend"), ("map_panel", "PLEACH_PT_map")):
            layout = Layout()
            getattr(scene.module(module), kind).draw(types.SimpleNamespace(layout=layout), bpy.context)
            self.assertIn("levels", " ".join(layout.shown), kind)

    def test_every_family_but_grammars_blends_within_itself(self) -> None:
        library, panel = pleach(), bpy.context.scene.pleach
        families: dict[str, list[str]] = {}
        for name in library.species():
            families.setdefault(library.species(name).generator, []).append(name)
        for family, (one, other, *_) in families.items():
            scene.empty()
            panel = bpy.context.scene.pleach
            panel.blend_from, panel.blend_with = one, other
            if family == "lsystem":
                with self.assertRaisesRegex(RuntimeError, "another model"):
                    bpy.ops.pleach.blend()
            else:
                self.assertEqual(bpy.ops.pleach.blend(), {"FINISHED"}, family)
        panel.blend_from, panel.blend_with = "acer", "leafy_oak"
        layout = Layout()
        kind = scene.module("panel").PLEACH_PT_blend
        kind.draw(types.SimpleNamespace(layout=layout), bpy.context)
        self.assertIn("only species of one family blend", " ".join(layout.shown))
