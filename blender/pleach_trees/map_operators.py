"""A tree by a click on the map of species."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import BoolProperty, FloatProperty

from . import library, plane, result, sliders, state
from .operators import Tool, regrow


class PLEACH_OT_map(Tool):
    """Make the map of species an image, and show it in the Image Editors that are open"""

    bl_idname = "pleach.map"
    bl_label = "Show Map"

    def run(self, context: Any) -> None:
        picture = plane.image()
        editors = [area for window in context.window_manager.windows for area in window.screen.areas if area.type == "IMAGE_EDITOR"]
        for area in editors:
            area.spaces.active.image = picture
            area.spaces.active.show_region_ui = True
            area.tag_redraw()
        if not editors:
            self.report({"INFO"}, f"Open an Image Editor, choose the image {plane.IMAGE} there, and press N: the tab pleach")


class PLEACH_OT_map_go(Tool):
    """Turn the active tree into the tree at a point of the map; without an active tree one is grown"""

    bl_idname = "pleach.map_go"
    bl_label = "Tree of the Map"

    x: FloatProperty(name="X", description="To the right on the map")
    y: FloatProperty(name="Y", description="Upwards on the map")
    new: BoolProperty(name="New", description="Grow another tree at the cursor, whatever is active", default=False)

    @classmethod
    def poll(cls, context: Any) -> bool:
        return context.mode == "OBJECT"

    def run(self, context: Any) -> set[str] | None:
        place = plane.at(self.x, self.y)
        thing = None if self.new else state.tree_of(context)
        if thing is None:
            thing = result.new(context, place.species)
        elif regrow(self, thing, place.species) == {"CANCELLED"}:
            return {"CANCELLED"}
        with sliders.silently():
            thing.pleach.map_x, thing.pleach.map_y = self.x, self.y
        self.report({"INFO"}, place.words)
        return None


class PLEACH_OT_map_click(bpy.types.Operator):
    """Click on the map for the tree that is there, as often as you like; Esc or a right click ends it"""

    bl_idname = "pleach.map_click"
    bl_label = "Click on Map"
    bl_options = {"INTERNAL"}

    new: BoolProperty(name="New", description="Grow another tree for each click", default=False)

    @classmethod
    def poll(cls, context: Any) -> bool:
        if not library.pleach or not _shows_map(context.area):
            cls.poll_message_set(f"Show the image {plane.IMAGE} in an Image Editor first")
            return False
        return True

    def invoke(self, context: Any, _event: Any) -> set[str]:
        self.area = context.area
        context.window.cursor_modal_set("CROSSHAIR")
        context.workspace.status_text_set("Click on the map for the tree that is there. Esc or a right click ends it")
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: Any, event: Any) -> set[str]:
        if event.type in ("ESC", "RIGHTMOUSE") or not self._is_open(context):
            self.cancel(context)
            return {"FINISHED"}
        if event.type != "LEFTMOUSE" or event.value != "PRESS":
            return {"PASS_THROUGH"}
        place = click_at(self.area, event.mouse_x, event.mouse_y)
        if place is None:
            return {"PASS_THROUGH"}
        point = plane.point_at(*place)
        if point is None:
            self.report({"INFO"}, "Click inside the frame of the map")
            return {"RUNNING_MODAL"}
        x, y = point
        # With an entry of its own in the history of undo. What is wrong is reported by it.
        try:
            bpy.ops.pleach.map_go("EXEC_DEFAULT", True, x=x, y=y, new=self.new)
        except RuntimeError as error:
            self.report({"ERROR"}, str(error))
        return {"RUNNING_MODAL"}

    def _is_open(self, context: Any) -> bool:
        return any(area == self.area for area in context.screen.areas) and _shows_map(self.area)

    def cancel(self, context: Any) -> None:
        context.window.cursor_modal_restore()
        context.workspace.status_text_set(None)


def _shows_map(area: Any) -> bool:
    if area is None or area.type != "IMAGE_EDITOR":
        return False
    picture = area.spaces.active.image
    return picture is not None and picture.name == plane.IMAGE


def click_at(area: Any, x: int, y: int) -> tuple[float, float] | None:
    """Where on the picture of an Image Editor a pixel of the window is, 0 to 1 each; `None` beside it or over a sidebar."""
    def holds(region: Any) -> bool:
        return region.x <= x < region.x + region.width and region.y <= y < region.y + region.height

    over = [region for region in area.regions if region.type != "WINDOW" and region.width > 1 and holds(region)]
    view = next((region for region in area.regions if region.type == "WINDOW"), None)
    if view is None or over or not holds(view):
        return None
    across, up = view.view2d.region_to_view(x - view.x, y - view.y)
    return (across, up) if 0.0 <= across <= 1.0 and 0.0 <= up <= 1.0 else None


CLASSES = (PLEACH_OT_map, PLEACH_OT_map_go, PLEACH_OT_map_click)
