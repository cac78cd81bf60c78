"""Growing, and everything that changes a tree at one press."""

from __future__ import annotations

import random
from typing import Any

import bpy
from bpy.props import StringProperty

from . import library, result, sliders, state, thumbnails


class Tool(bpy.types.Operator):
    """What all operators share: they tell what is wrong instead of failing with a trace."""

    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: Any) -> set[str]:
        if not library.pleach:
            self.report({"ERROR"}, library.MISSING)
            return {"CANCELLED"}
        try:
            return self.run(context) or {"FINISHED"}
        except library.pleach.PleachError as error:
            self.report({"ERROR"}, str(error))
        except OSError as error:
            self.report({"ERROR"}, f"{error.filename or 'file'}: {error.strerror or error}")
        return {"CANCELLED"}

    def run(self, context: Any) -> set[str] | None:
        """What the operator does. Raises ``PleachError`` and ``OSError``."""
        raise NotImplementedError


class AsksForFile:
    """What operators on a file share: they ask for it first."""

    filepath: StringProperty(subtype="FILE_PATH")

    def invoke(self, context: Any, _event: Any) -> set[str]:
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}


class OfTree(Tool):
    """An operator on the active tree."""

    @classmethod
    def poll(cls, context: Any) -> bool:
        thing = state.tree_of(context)
        if thing is None:
            cls.poll_message_set("Select a tree of pleach's")
            return False
        return context.mode == "OBJECT"

    def regrow(self, thing: Any, species: Any | None = None) -> set[str]:
        return regrow(self, thing, species)


def regrow(operator: Any, thing: Any, species: Any | None = None) -> set[str]:
    """Grows the tree of an object again, and reports what is wrong: what an operator returns."""
    if state.grow_again(thing, species):
        return {"FINISHED"}
    operator.report({"ERROR"}, state.problems.get(thing.session_uid, "the tree does not grow"))
    return {"CANCELLED"}

class PLEACH_OT_grow(Tool):
    """Grow a tree of the chosen species at the cursor"""

    bl_idname = "pleach.grow"
    bl_label = "Grow Tree"

    species: StringProperty(name="Species", description="Name of the species; empty for the one that is chosen in the panel")

    def run(self, context: Any) -> None:
        species = library.pleach.species(self.species or context.scene.pleach.species)
        result.new(context, species)


class PLEACH_OT_become(OfTree):
    """Turn the active tree into one of the chosen species, with its materials and leaves kept"""

    bl_idname = "pleach.become"
    bl_label = "Change Species"

    species: StringProperty(name="Species", description="Name of the species; empty for the one that is chosen in the panel")

    def run(self, context: Any) -> set[str]:
        species = library.pleach.species(self.species or context.scene.pleach.species)
        return self.regrow(state.tree_of(context), species)


class PLEACH_OT_again(OfTree):
    """Grow the active tree again; edits of its curves are lost"""

    bl_idname = "pleach.again"
    bl_label = "Grow Again"

    def run(self, context: Any) -> set[str]:
        return self.regrow(state.tree_of(context))


class PLEACH_OT_seed(OfTree):
    """Another tree of the same species"""

    bl_idname = "pleach.seed"
    bl_label = "Another Seed"

    def run(self, context: Any) -> set[str]:
        thing = state.tree_of(context)
        with sliders.silently():
            thing.pleach.seed = random.randint(1, 99999)
        return self.regrow(thing)


class PLEACH_OT_dice(OfTree):
    """Move all sliders that are not locked, each by a part of its usual range"""

    bl_idname = "pleach.dice"
    bl_label = "Roll Dice"

    def run(self, context: Any) -> set[str]:
        thing, spread = state.tree_of(context), context.scene.pleach.spread
        species = library.species_of(thing.pleach.species_text)
        locked, values = {lock.name for lock in thing.pleach.locks}, sliders.flat(species)
        changes: dict[str, Any] = {}
        for slider in sliders.space_of(species).sliders:
            value = values.get(slider.key)
            if value is None or slider.key in locked or slider.choices or slider.hard == slider.soft:
                continue
            # Numbers that a species has at 0 are what it does without.
            if value == 0 or slider.whole:
                continue
            low, high = slider.soft
            near = value + random.uniform(-0.5, 0.5) * spread * (high - low)
            changes[slider.key] = min(max(near, min(low, value)), max(high, value))
        return self.regrow(thing, species.replace(changes))


class PLEACH_OT_lock(OfTree):
    """Keep the dice off this slider, or let them on it again"""

    bl_idname = "pleach.lock"
    bl_label = "Lock Slider"

    key: StringProperty(name="Number")

    def run(self, context: Any) -> None:
        locks = state.tree_of(context).pleach.locks
        found = locks.find(self.key)
        if found >= 0:
            locks.remove(found)
        else:
            locks.add().name = self.key


class PLEACH_OT_reset(OfTree):
    """Put all sliders back to the species that is built in"""

    bl_idname = "pleach.reset"
    bl_label = "Reset"

    def run(self, context: Any) -> set[str]:
        thing = state.tree_of(context)
        name = thing.pleach.species_name
        if name not in library.pleach.species():
            raise library.pleach.SpeciesError(f"`{name}` is not built in: there is nothing to go back to")
        return self.regrow(thing, library.pleach.species(name))


class PLEACH_OT_blend(Tool):
    """Turn the active tree into one between two species; without an active tree one is grown"""

    bl_idname = "pleach.blend"
    bl_label = "Blend"

    @classmethod
    def poll(cls, context: Any) -> bool:
        return context.mode == "OBJECT"

    def run(self, context: Any) -> set[str] | None:
        panel, thing = context.scene.pleach, state.tree_of(context)
        other = library.pleach.species(panel.blend_with)
        if panel.blend_from != thumbnails.ACTIVE:
            one = library.pleach.species(panel.blend_from)
        elif thing is not None:
            one = library.species_of(thing.pleach.species_text)
        else:
            raise library.pleach.SpeciesError("there is no active tree: select one, or choose a species to start from")
        if one.name == other.name and one != other:
            one = one.named(f"{one.name[:50]}_here")
        shares = {one: 1.0 - panel.blend, other: panel.blend}
        # Between a species and itself there is nothing else.
        mixed = one if len(shares) == 1 else library.pleach.blend(shares, name=f"{one.name}_{other.name}"[:60])
        if thing is None:
            result.new(context, mixed)
            return None
        return regrow(self, thing, mixed)


class PLEACH_OT_group(bpy.types.Operator):
    """Show the sliders of this group, or hide them"""

    bl_idname = "pleach.group"
    bl_label = "Open Group"
    bl_options = {"INTERNAL"}

    group: StringProperty()

    def execute(self, context: Any) -> set[str]:
        panel = context.scene.pleach
        panel.open_group = "" if panel.open_group == self.group else self.group
        return {"FINISHED"}


CLASSES = (
    PLEACH_OT_grow, PLEACH_OT_become, PLEACH_OT_again, PLEACH_OT_seed, PLEACH_OT_dice, PLEACH_OT_lock, PLEACH_OT_reset,
    PLEACH_OT_blend, PLEACH_OT_group,
)
