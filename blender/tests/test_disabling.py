"""The extension taken away, and without its library."""

from __future__ import annotations

import sys
import types
import unittest

import scene  # noqa: I001 # sets where Blender keeps settings, before bpy is loaded
import bpy
from test_panels import Layout


def setUpModule() -> None:
    scene.install()


class Disabling(unittest.TestCase):
    def test_nothing_is_left_behind(self) -> None:
        import addon_utils

        scene.empty()
        scene.grow("acer")

        def ours() -> set[str]:
            things = (bpy.types, bpy.types.Object, bpy.types.Scene)
            found = {f"{thing.__name__}.{name}" for thing in things for name in dir(thing) if "pleach" in name.lower()}
            handlers = {f"{name}: {one}" for name in dir(bpy.app.handlers) for one in _handlers(name) if "pleach" in one}
            return found | handlers

        self.assertTrue(ours())
        for _ in range(2):
            addon_utils.disable(scene.MODULE, default_set=True)
            self.assertEqual(ours(), set())
            self.assertIn("acer", bpy.data.objects)
            self.assertGreater(len(bpy.data.objects["acer"].data.curves), 10, "the tree stays")
            addon_utils.enable(scene.MODULE, default_set=True)
            self.assertIn("PLEACH_PT_grow", dir(bpy.types))
        thing = bpy.data.objects["acer"]
        self.assertTrue(thing.pleach.is_tree)
        thing.pleach.seed = 3
        self.assertGreater(scene.counts(thing)["leaves"], 1000)

    def test_without_the_library_it_says_so(self) -> None:
        import addon_utils

        addon_utils.disable(scene.MODULE, default_set=True)
        kept = {name: one for name, one in sys.modules.items() if name.split(".")[0] == "pleach" or name.startswith(scene.MODULE)}
        for name in kept:
            del sys.modules[name]
        sys.modules["pleach"] = None  # type: ignore[assignment] # what an import of a missing package finds
        try:
            addon_utils.enable(scene.MODULE, default_set=True)
            with self.assertRaisesRegex(RuntimeError, "install the zip"):
                bpy.ops.pleach.grow(species="acer")
            layout = Layout()
            scene.module("panel").PLEACH_PT_grow.draw(types.SimpleNamespace(layout=layout), bpy.context)
            self.assertIn("install the zip", " ".join(layout.shown))
        finally:
            addon_utils.disable(scene.MODULE, default_set=True)
            for name in [name for name in sys.modules if name == "pleach" or name.startswith(scene.MODULE)]:
                del sys.modules[name]
            sys.modules.update({name: one for name, one in kept.items() if name.split(".")[0] == "pleach"})
            addon_utils.enable(scene.MODULE, default_set=True)
        self.assertEqual(bpy.ops.pleach.grow(species="acer"), {"FINISHED"})


def _handlers(name: str) -> list[str]:
    some = getattr(bpy.app.handlers, name)
    return [f"{one.__module__}.{one.__name__}" for one in some if callable(one)] if isinstance(some, list) else []
