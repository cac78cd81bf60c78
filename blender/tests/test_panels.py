"""What the panels show."""

from __future__ import annotations

import types
import unittest
from typing import Any

import scene  # noqa: I001 # sets where Blender keeps settings, before bpy is loaded
import bpy

#: One of each family.
FIVE = ("quaking_aspen", "stylised_oak", "field_maple", "coffey_pine", "leafy_oak")


def setUpModule() -> None:
    scene.install()


def pleach() -> Any:
    return scene.module("library").pleach


class Layout:
    """Stands for a layout of Blender's, and checks that what is shown is there."""

    def __init__(self) -> None:
        self.shown: list[str] = []

    def prop(self, data: Any, name: str, text: str = "", **_: Any) -> None:
        # An input of a modifier is shown under another name.
        if name.startswith('["'):
            assert name[2:-2] in data.keys(), f"{data} has no {name}"
            name = text
        else:
            assert name in data.bl_rna.properties, f"{data} has no {name}"
        self.shown.append(name)

    def operator(self, name: str, **_: Any) -> Any:
        group, _, short = name.partition(".")
        properties = getattr(getattr(bpy.ops, group), short).get_rna_type().properties
        self.shown.append(name)
        return _Settings(properties)

    def template_icon_view(self, data: Any, name: str, **_: Any) -> None:
        self.prop(data, name)

    def template_ID(self, data: Any, name: str, **_: Any) -> None:  # noqa: N802 # Blender's name
        self.prop(data, name)

    def template_icon(self, *_: Any, **__: Any) -> None:
        self.shown.append("icon")

    def progress(self, *, text: str, factor: float) -> None:
        assert 0 <= factor <= 1
        self.shown.append(text)

    def label(self, *, text: str, icon: str) -> None:
        self.shown.append(text)

    def column(self, **_: Any) -> "Layout":
        return self

    row = column


class _Settings:
    def __init__(self, properties: Any) -> None:
        object.__setattr__(self, "properties", properties)

    def __setattr__(self, name: str, _value: Any) -> None:
        assert name in self.properties, f"the operator has no {name}"


class Panels(unittest.TestCase):
    def setUp(self) -> None:
        scene.empty()

    def drawn(self) -> list[str]:
        layout = Layout()
        for kind in scene.module("panel").CLASSES:
            if not hasattr(kind, "poll") or kind.poll(bpy.context):
                kind.draw(types.SimpleNamespace(layout=layout), bpy.context)
        return layout.shown

    def test_panels_show_what_there_is(self) -> None:
        self.assertIn("species", self.drawn())
        self.assertNotIn("seed", self.drawn())
        for name in FIVE:
            thing = scene.grow(name)
            shown = self.drawn()
            self.assertTrue(any(word.startswith(f"{name}: ") for word in shown), shown)
            species = pleach().species(name)
            space = scene.module("sliders").space_of(species)
            first = scene.module("sliders").first_of(space)
            self.assertTrue({slider.prop for slider in first} <= set(shown))
            # All groups together have all sliders.
            seen = set()
            for group in space.groups:
                bpy.ops.pleach.group(group=group)
                seen |= set(self.drawn())
                bpy.ops.pleach.group(group=group)
            self.assertTrue({slider.prop for slider in space.sliders} <= seen)
            # A part of the tree stands for it.
            child = next(iter(thing.children), None)
            if child is not None:
                bpy.context.view_layer.objects.active = child
                self.assertIn("seed", self.drawn())

    def test_every_species_has_a_picture(self) -> None:
        folder = scene.module("thumbnails").FOLDER
        self.assertEqual({path.stem for path in folder.glob("*.png")}, set(pleach().species()))
        image = bpy.data.images.load(str(folder / "acer.png"))
        self.assertEqual(tuple(image.size), (56, 56))

    def test_a_running_fit_is_shown(self) -> None:
        fitting = scene.module("fitting")
        ink = pleach().species("acer").grow(5).silhouette(64)
        job = fitting.start(ink, timeout=600.0, start="acer")
        try:
            shown = self.drawn()
            self.assertTrue(any("of 600 s" in word for word in shown), shown)
            self.assertIn("pleach.stop", shown)
            self.assertFalse(bpy.ops.pleach.fit.poll())
        finally:
            bpy.ops.pleach.stop()
            self.assertTrue(job.wait(60))
