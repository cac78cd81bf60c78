"""How fast it is."""

from __future__ import annotations

import time
import unittest
from typing import Any

import scene  # noqa: I001 # sets where Blender keeps settings, before bpy is loaded
import bpy


def setUpModule() -> None:
    scene.install()


def pleach() -> Any:
    return scene.module("library").pleach


class Times(unittest.TestCase):
    """Of all threads together: a machine that is idle takes no longer, and one that is busy measures the same."""

    def setUp(self) -> None:
        scene.empty()

    def best(self, work: Any, before: Any = None) -> float:
        times = []
        for _ in range(4):
            if before:
                before()
            start, began = time.process_time(), time.perf_counter()
            work()
            bpy.context.evaluated_depsgraph_get().update()
            times.append(time.process_time() - start)
            print(f"  {times[-1]:.3f} s of the processor, {time.perf_counter() - began:.3f} s on the clock")
        return min(times[1:])

    def test_aspen(self) -> None:
        self.assertLess(self.best(lambda: scene.grow("quaking_aspen"), scene.empty), 0.15)

    def test_willow(self) -> None:
        self.assertLess(self.best(lambda: scene.grow("weeping_willow"), scene.empty), 1.5)

    def test_a_slider_of_the_aspen_with_a_tenth_of_its_leaves(self) -> None:
        thing = scene.grow("quaking_aspen")
        thing.pleach.leaf_share = 0.1
        group = getattr(thing, scene.module("sliders").space_of(pleach().species("quaking_aspen")).attribute)

        def slide() -> None:
            group.g_scale = group.g_scale + 0.1

        self.assertLess(self.best(slide), 0.1)

    def frame(self, name: str) -> float:
        """A frame of a tree in wind, evaluated as the viewport shows it."""
        scene.grow(name).pleach.wind = True

        def play() -> None:
            bpy.context.scene.frame_set(bpy.context.scene.frame_current + 1)

        return self.best(play)

    def test_a_frame_of_the_aspen_in_wind(self) -> None:
        self.assertLess(self.frame("quaking_aspen"), 0.08)

    def test_a_frame_of_the_willow_in_wind(self) -> None:
        self.assertLess(self.frame("weeping_willow"), 1.0)
