"""The panels of the map: in the sidebar of the 3D viewport, and in that of the Image Editor."""

from __future__ import annotations

from typing import Any

import bpy

from . import library, plane, state
from .panel import Panel, words


class PLEACH_PT_map(Panel):
    bl_label = "Map"
    bl_idname = "PLEACH_PT_map"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, _context: Any) -> bool:
        return library.pleach is not None

    def draw(self, context: Any) -> None:
        self.layout.operator("pleach.map", icon="IMAGE_DATA")
        _place(self.layout, context)


class PLEACH_PT_map_image(bpy.types.Panel):
    bl_label = "Map"
    bl_idname = "PLEACH_PT_map_image"
    bl_space_type = "IMAGE_EDITOR"
    bl_region_type = "UI"
    bl_category = "pleach"

    @classmethod
    def poll(cls, _context: Any) -> bool:
        return library.pleach is not None

    def draw(self, context: Any) -> None:
        layout, space = self.layout, context.space_data
        if space.image is None or space.image.name != plane.IMAGE:
            layout.operator("pleach.map", icon="IMAGE_DATA")
            return
        column = layout.column(align=True)
        change = column.operator("pleach.map_click", text="Change the Tree by Clicks", icon="FILE_REFRESH")
        change.new = False
        column.operator("pleach.map_click", text="Grow a Tree for Each Click", icon="ADD").new = True
        _place(layout, context)


def _place(layout: Any, context: Any) -> None:
    """Where the active tree is on the map."""
    thing = state.tree_of(context)
    if thing is None:
        return
    tree = thing.pleach
    try:
        place = plane.locate(library.species_of(tree.species_text))
    except library.pleach.PleachError as error:
        words(layout, str(error), "ERROR")
        return
    if place is None:
        text = f"{tree.species_name} is not of the family of the map, {plane.family()}: a click or a number makes it a tree of the map"
        words(layout, text, "INFO")
    column = layout.column(align=True)
    column.prop(tree, "map_x", slider=True)
    column.prop(tree, "map_y", slider=True)


CLASSES = (PLEACH_PT_map, PLEACH_PT_map_image)
