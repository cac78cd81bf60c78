"""The panels, in the sidebar of the 3D viewport (N)."""

from __future__ import annotations

from typing import Any

import bpy

from . import fit_operators, fitting, library, nodes, sliders, state, thumbnails, wind


class Panel(bpy.types.Panel):
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "pleach"


class OfTree(Panel):
    """A panel about the active tree."""

    @classmethod
    def poll(cls, context: Any) -> bool:
        return library.pleach is not None and state.tree_of(context) is not None


class PLEACH_PT_grow(Panel):
    bl_label = "Grow"
    bl_idname = "PLEACH_PT_grow"

    def draw(self, context: Any) -> None:
        layout, panel = self.layout, context.scene.pleach
        if library.MISSING:
            words(layout, library.MISSING, "ERROR")
            return
        layout.template_icon_view(panel, "species", show_labels=True, scale=6.0, scale_popup=5.0)
        layout.prop(panel, "species", text="")
        row = layout.row(align=True)
        row.operator("pleach.grow", icon="ADD").species = ""
        row.operator("pleach.become", text="Change", icon="FILE_REFRESH").species = ""
        row = layout.row(align=True)
        row.operator("pleach.load", icon="FILE_FOLDER")
        row.operator("pleach.save", icon="FILE_TICK")


class PLEACH_PT_tree(OfTree):
    bl_label = "Tree"
    bl_idname = "PLEACH_PT_tree"

    def draw(self, context: Any) -> None:
        layout, thing = self.layout, state.tree_of(context)
        tree = thing.pleach
        problem = state.problems.get(thing.session_uid)
        if problem:
            words(layout, problem, "ERROR")
        layout.label(text=f"{tree.species_name}: {tree.stem_count:,} stems, {tree.leaf_count:,} leaves", icon="OUTLINER_OB_CURVES")
        row = layout.row(align=True)
        row.prop(tree, "seed")
        row.operator("pleach.seed", text="", icon="FILE_REFRESH")
        layout.prop(tree, "season")
        layout.prop(tree, "leaf_share", slider=True)
        layout.prop(tree, "roots")
        layout.prop(tree, "bark")
        if tree.bark == "MESH":
            layout.prop(tree, "tolerance")
            layout.prop(tree, "textures")
        row = layout.row(align=True)
        row.operator("pleach.dice", icon="MOD_NOISE")
        row.prop(context.scene.pleach, "spread", slider=True)
        row = layout.row(align=True)
        row.operator("pleach.reset", icon="LOOP_BACK")
        row.operator("pleach.again", icon="FILE_REFRESH")


class PLEACH_PT_sliders(OfTree):
    bl_label = "Sliders"
    bl_idname = "PLEACH_PT_sliders"
    bl_parent_id = "PLEACH_PT_tree"

    def draw(self, context: Any) -> None:
        layout, thing = self.layout, state.tree_of(context)
        try:
            species = library.species_of(thing.pleach.species_text)
        except library.pleach.PleachError as error:
            words(layout, str(error), "ERROR")
            return
        space = sliders.known_space(species)
        if space is None:
            layout.operator("pleach.again")
            return
        group = getattr(thing, space.attribute)
        locked = {lock.name for lock in thing.pleach.locks}
        first = sliders.first_of(space)
        column = layout.column(align=True)
        for slider in first:
            _slider(column, group, slider, locked, text=slider.handle)
        opened = context.scene.pleach.open_group
        for name in space.groups:
            is_open = name == opened
            row = layout.row()
            row.operator("pleach.group", text=name.capitalize(), emboss=False,
                         icon="DOWNARROW_HLT" if is_open else "RIGHTARROW").group = name
            if is_open:
                column = layout.column(align=True)
                for slider in space.sliders:
                    if slider.group == name:
                        _slider(column, group, slider, locked)


def _slider(column: Any, group: Any, slider: sliders.Slider, locked: set[str], text: str | None = None) -> None:
    row = column.row(align=True)
    # Without a text it is the number's own name.
    row.prop(group, slider.prop, slider=not slider.whole, **({} if text is None else {"text": text}))
    is_locked = slider.key in locked
    row.operator("pleach.lock", text="", icon="LOCKED" if is_locked else "UNLOCKED", emboss=is_locked).key = slider.key


class PLEACH_PT_wind(OfTree):
    bl_label = "Wind"
    bl_idname = "PLEACH_PT_wind"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header(self, context: Any) -> None:
        self.layout.prop(state.tree_of(context).pleach, "wind", text="")

    def draw(self, context: Any) -> None:
        modifier = wind.modifier_of(state.tree_of(context))
        if modifier is None:
            self.layout.label(text="The air is still", icon="FORCE_WIND")
            return
        for name in wind.SETTINGS:
            key = nodes.key_of(modifier, name)
            if key is not None:
                self.layout.prop(modifier, f'["{key}"]', text=name)
        self.layout.operator("pleach.same_wind", icon="FORCE_WIND")


class PLEACH_PT_blend(Panel):
    bl_label = "Blend"
    bl_idname = "PLEACH_PT_blend"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, _context: Any) -> bool:
        return library.pleach is not None

    def draw(self, context: Any) -> None:
        layout, panel = self.layout, context.scene.pleach
        column = layout.column(align=True)
        column.prop(panel, "blend_from", text="")
        column.prop(panel, "blend_with", text="")
        layout.prop(panel, "blend", slider=True)
        tree = state.tree_of(context)
        name, one = panel.blend_from, None
        if name != thumbnails.ACTIVE:
            one = library.family_of(name)
        elif tree is not None:
            try:
                name, one = tree.pleach.species_name, library.species_of(tree.pleach.species_text).generator
            except library.pleach.PleachError as error:
                words(layout, str(error), "ERROR")
                return
        other = library.family_of(panel.blend_with)
        if one is None:
            words(layout, "Select a tree, or choose a species to start from", "INFO")
        elif one != other:
            words(layout, f"{name} is of the family {one}, {panel.blend_with} of {other}: only species of one family blend", "ERROR")
        layout.operator("pleach.blend")


class PLEACH_PT_fit(Panel):
    bl_label = "Fit a Picture"
    bl_idname = "PLEACH_PT_fit"

    @classmethod
    def poll(cls, _context: Any) -> bool:
        return library.pleach is not None

    def draw(self, context: Any) -> None:
        layout, panel = self.layout, context.scene.pleach
        row = layout.row(align=True)
        row.template_ID(panel, "picture", open="pleach.open_picture")
        reading = bpy.data.images.get(fit_operators.READING)
        if reading is not None and reading.preview:
            layout.template_icon(reading.preview.icon_id, scale=8.0)
        job = fitting.running()
        if job is not None:
            part = fit_operators.progress(job)
            text = f"{job.stage}, {job.elapsed:.0f} of {job.seconds:.0f} s"
            if job.likeness is not None:
                text += f", likeness {job.likeness:.2f}"
            layout.progress(text=text, factor=part)
            row = layout.row(align=True)
            row.operator("pleach.stop", text="Take What There Is").keep = True
            row.operator("pleach.stop", text="Cancel", icon="CANCEL").keep = False
            return
        layout.prop(panel, "height")
        layout.prop(panel, "seconds")
        layout.prop(panel, "family")
        layout.prop(panel, "very_tree")
        row = layout.row(align=True)
        row.operator("pleach.read", icon="VIEWZOOM")
        row.operator("pleach.fit", icon="OUTLINER_OB_IMAGE")


class PLEACH_PT_bake(OfTree):
    bl_label = "Bake to Mesh"
    bl_idname = "PLEACH_PT_bake"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Any) -> None:
        panel = context.scene.pleach
        self.layout.prop(panel, "budgets")
        self.layout.prop(panel, "bake_textures")
        self.layout.operator("pleach.bake", icon="OUTLINER_OB_MESH")


def words(layout: Any, text: str, icon: str) -> None:
    """A text on as many lines as it needs."""
    line, lines = "", []
    for word in text.split():
        if len(line) + len(word) > 42:
            lines.append(line)
            line = ""
        line = f"{line} {word}".strip()
    for number, one in enumerate([*lines, line]):
        layout.label(text=one, icon=icon if number == 0 else "BLANK1")


CLASSES = (PLEACH_PT_grow, PLEACH_PT_tree, PLEACH_PT_sliders, PLEACH_PT_wind, PLEACH_PT_blend, PLEACH_PT_fit, PLEACH_PT_bake)
