"""From a picture to a tree."""

from __future__ import annotations

import os
from typing import Any

import bpy
from bpy.props import StringProperty

from . import fitting, library, result
from .operators import AsksForFile, Tool

READING, MASK = "pleach reading", "pleach mask"


def _options(context: Any) -> dict[str, Any]:
    panel = context.scene.pleach
    return {
        "height": panel.height,
        "timeout": panel.seconds,
        "individual": panel.very_tree,
        "generator": None if panel.family == "AUTO" else panel.family,
        "name": safe_name(panel.picture.name),
    }


def safe_name(name: str) -> str:
    """A picture's name as that of a species: letters, digits and underscores."""
    stem = os.path.splitext(name)[0]
    text = "".join(letter if letter.isascii() and letter.isalnum() else "_" for letter in stem).strip("_").lower()
    return text[:40] or "fit"


class OfPicture(Tool):
    """An operator on the picture of the panel."""

    @classmethod
    def poll(cls, context: Any) -> bool:
        if context.scene.pleach.picture is None:
            cls.poll_message_set("Choose a picture first")
            return False
        return fitting.running() is None


class PLEACH_OT_open(AsksForFile, Tool):
    """Open a picture of a tree"""

    bl_idname = "pleach.open_picture"
    bl_label = "Open Picture"

    filter_glob: StringProperty(default="*.png;*.jpg;*.jpeg;*.webp;*.bmp;*.tif;*.tiff;*.exr", options={"HIDDEN"})

    def run(self, context: Any) -> None:
        try:
            image = bpy.data.images.load(self.filepath, check_existing=True)
        except RuntimeError as error:
            raise library.pleach.GoalError(str(error)) from error
        if not image.size[0]:
            bpy.data.images.remove(image)
            raise library.pleach.GoalError(f"{self.filepath} is no picture that Blender can read")
        context.scene.pleach.picture = image


class PLEACH_OT_read(OfPicture):
    """Show what a fit sees in the picture: what is tree, the trunk, the crown, the first fork"""

    bl_idname = "pleach.read"
    bl_label = "Read Picture"

    def run(self, context: Any) -> None:
        panel = context.scene.pleach
        reading = library.pleach.read(fitting.pixels(panel.picture))
        fitting.to_image(READING, reading.annotated).preview_ensure()
        ink = (~reading.ink[..., None]).repeat(3, axis=2).astype("uint8") * 255
        fitting.to_image(MASK, ink).preview_ensure()
        trunks = len(reading["feet"])
        self.report({"INFO"}, f"{trunks} trunk{'s' if trunks != 1 else ''}; see the image {READING}")


class PLEACH_OT_fit(OfPicture):
    """Find the tree of the picture and grow it at the cursor; the viewport goes on working"""

    bl_idname = "pleach.fit"
    bl_label = "Fit Picture"

    def execute(self, context: Any) -> set[str]:
        """Without a window there is nobody to wait for: the fit is made at once."""
        self.job = None
        return super().execute(context)

    def run(self, context: Any) -> None:
        job = fitting.start(fitting.pixels(context.scene.pleach.picture), **_options(context))
        job.wait()
        finish(self, context, job)

    def invoke(self, context: Any, _event: Any) -> set[str]:
        if not library.pleach:
            return self.execute(context)
        try:
            self.job = fitting.start(fitting.pixels(context.scene.pleach.picture), **_options(context))
        except library.pleach.PleachError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        window = context.window_manager
        self.timer = window.event_timer_add(0.2, window=context.window)
        window.progress_begin(0, 100)
        window.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: Any, event: Any) -> set[str]:
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        job = self.job
        context.window_manager.progress_update(progress(job) * 100)
        for area in context.screen.areas if context.screen else ():
            if area.type == "VIEW_3D":
                area.tag_redraw()
        # A tree cannot be added while another object is edited.
        if job.running or context.mode != "OBJECT":
            return {"PASS_THROUGH"}
        self._end(context)
        try:
            finish(self, context, job)
        except library.pleach.PleachError as error:
            self.report({"WARNING" if job.error == "cancelled" else "ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}

    def cancel(self, context: Any) -> None:
        self.job.cancel()
        self._end(context)

    def _end(self, context: Any) -> None:
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()


def progress(job: fitting.Job) -> float:
    """How far a fit is, 0 to 1: by its time, which all its steps share."""
    return min(1.0, job.elapsed / job.seconds) if job.seconds else job.used


def finish(operator: Any, context: Any, job: fitting.Job) -> None:
    """Grows what a fit has found. Raises ``pleach.PleachError``."""
    if job.fit is None:
        raise library.pleach.FitError(job.error)
    species = job.fit.best
    thing = result.new(context, species)
    thing["pleach_likeness"] = job.fit.card.likeness
    fitting.to_image(f"{thing.name} over picture", job.fit.overlay())
    operator.report({"INFO"}, f"{species.name}: likeness {job.fit.card.likeness:.2f}; {job.fit.verdict or ''}".rstrip("; "))


class PLEACH_OT_stop(bpy.types.Operator):
    """End the fit that is running"""

    bl_idname = "pleach.stop"
    bl_label = "End Fit"
    bl_options = {"INTERNAL"}

    keep: bpy.props.BoolProperty(name="Keep", description="Grow what was found so far", default=False)

    @classmethod
    def poll(cls, _context: Any) -> bool:
        return fitting.running() is not None

    def execute(self, _context: Any) -> set[str]:
        job = fitting.running()
        if job is not None:
            (job.finish if self.keep else job.cancel)()
        return {"FINISHED"}


CLASSES = (PLEACH_OT_open, PLEACH_OT_read, PLEACH_OT_fit, PLEACH_OT_stop)
