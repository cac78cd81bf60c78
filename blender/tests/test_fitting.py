"""From pictures to trees."""

from __future__ import annotations

import os
import pathlib
import tempfile
import time
import unittest
from typing import Any

import scene  # noqa: I001 # sets where Blender keeps settings, before bpy is loaded
import bpy
import numpy as np


def setUpModule() -> None:
    scene.install()


def pleach() -> Any:
    return scene.module("library").pleach


class Fitting(unittest.TestCase):
    def setUp(self) -> None:
        scene.empty()
        panel = bpy.context.scene.pleach
        ink = pleach().species("acer").grow(5).silhouette(96)
        picture = np.where(ink[..., None], np.uint8([0, 0, 0]), np.uint8([255, 255, 255]))
        panel.picture = scene.module("fitting").to_image("goal", picture)
        panel.family, panel.seconds = "weber-penn", 3.0

    def test_three_seconds(self) -> None:
        # Of the processor, for the machine may be busy with other things.
        started = time.process_time()
        self.assertEqual(bpy.ops.pleach.fit(), {"FINISHED"})
        self.assertLess(time.process_time() - started, 60)
        thing = bpy.context.active_object
        self.assertTrue(thing.pleach.is_tree)
        self.assertEqual(thing.pleach.species_name, "goal")
        self.assertGreater(thing["pleach_likeness"], 0.4)
        self.assertGreater(scene.counts(thing)["bark"], 0)
        self.assertIn("goal over picture", bpy.data.images)

    def test_progress_and_cancel(self) -> None:
        fitting = scene.module("fitting")
        panel = bpy.context.scene.pleach
        job = fitting.start(fitting.pixels(panel.picture), timeout=600.0, start="acer")
        with self.assertRaisesRegex(pleach().FitError, "is running"):
            fitting.start(fitting.pixels(panel.picture), timeout=1.0)
        # This thread goes on meanwhile, as the viewport does.
        grown = 0
        while job.stage == "first guess" and job.elapsed < 30 and grown < 5:
            scene.grow("palm")
            grown += 1
        self.assertTrue(job.running and grown >= 1)
        job.cancel()
        self.assertTrue(job.wait(30))
        self.assertIsNone(job.fit)
        self.assertEqual(job.error, "cancelled")

    def test_what_there_is_can_be_taken(self) -> None:
        fitting = scene.module("fitting")
        job = fitting.start(fitting.pixels(bpy.context.scene.pleach.picture), timeout=600.0, start="acer", individual=False)
        while job.stage != "search" and job.elapsed < 60:
            time.sleep(0.1)
        job.finish()
        self.assertTrue(job.wait(60))
        self.assertTrue(job.fit is not None and job.fit.interrupted, job.error)

    def test_reading(self) -> None:
        bpy.ops.pleach.read()
        self.assertIn("pleach reading", bpy.data.images)
        self.assertIn("pleach mask", bpy.data.images)

    def test_pictures_of_all_kinds(self) -> None:
        fitting, panel = scene.module("fitting"), bpy.context.scene.pleach
        wanted = fitting.pixels(panel.picture)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "goal.png")
            panel.picture.save(filepath=path)
            bpy.ops.pleach.open_picture(filepath=path)
            self.assertTrue(np.array_equal(fitting.pixels(panel.picture), wanted))
            panel.picture.pack()
            os.remove(path)
            self.assertTrue(np.array_equal(fitting.pixels(panel.picture), wanted), "packed, and its file is gone")
            text = os.path.join(folder, "no-picture.png")
            pathlib.Path(text).write_text("no picture")
            with self.assertRaisesRegex(RuntimeError, "no picture"):
                bpy.ops.pleach.open_picture(filepath=text)
        lost = bpy.data.images.new("lost", 4, 4)
        lost.source, lost.filepath = "FILE", "/nowhere/lost.png"
        panel.picture = lost
        with self.assertRaisesRegex(RuntimeError, "lost"):
            bpy.ops.pleach.fit()
