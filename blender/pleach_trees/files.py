"""Species files, and meshes that are baked."""

from __future__ import annotations

import pathlib
from typing import Any

import bpy
from bpy.props import StringProperty

from . import library, materials, meshes, result, state, wind
from .operators import AsksForFile, OfTree, Tool


class PLEACH_OT_load(AsksForFile, Tool):
    """Grow the tree of a species file (.toml), such as `pleach fit` writes"""

    bl_idname = "pleach.load"
    bl_label = "Open Species"

    filter_glob: StringProperty(default="*.toml", options={"HIDDEN"})

    def run(self, context: Any) -> None:
        result.new(context, library.pleach.species(pathlib.Path(bpy.path.abspath(self.filepath))))


class PLEACH_OT_save(AsksForFile, OfTree):
    """Write the species of the active tree, with its seed, to a file that pleach reads"""

    bl_idname = "pleach.save"
    bl_label = "Save Species"

    filter_glob: StringProperty(default="*.toml", options={"HIDDEN"})

    def invoke(self, context: Any, event: Any) -> set[str]:
        self.filepath = f"{state.tree_of(context).pleach.species_name}.toml"
        return super().invoke(context, event)

    def run(self, context: Any) -> None:
        tree = state.tree_of(context).pleach
        species = library.species_of(tree.species_text).named(tree_seed=tree.seed)
        path = pathlib.Path(bpy.path.abspath(self.filepath)).with_suffix(".toml")
        path.write_text(species.to_toml(), encoding="utf-8")
        self.report({"INFO"}, f"{path} is written")


class PLEACH_OT_bake(OfTree):
    """Make meshes of the active tree for games, a level of detail for each number of triangles; the tree stays"""

    bl_idname = "pleach.bake"
    bl_label = "Bake to Mesh"

    def run(self, context: Any) -> None:
        thing, panel = state.tree_of(context), context.scene.pleach
        options: dict[str, Any] = {"roots": thing.pleach.roots, "triangles": budgets(panel.budgets), "wind": thing.pleach.wind}
        season = result.SEASONS[thing.pleach.season]
        if season:
            options["season"] = season
        if panel.bake_textures != "NONE":
            options["textures"] = int(panel.bake_textures)
        species = library.species_of(thing.pleach.species_text)
        made = species.grow(thing.pleach.seed).mesh(**options)
        collection = bpy.data.collections.new(f"{thing.name} meshes")
        context.scene.collection.children.link(collection)
        palette = species.palette(season)
        kinds: dict[str, Any] = {}
        for number, parts in enumerate(made.levels):
            if not parts:
                continue
            name = f"{thing.name}_LOD{number}"
            mesh, names = meshes.of_parts(name, parts)
            for kind in names:
                if kind not in kinds:
                    kinds[kind] = _material(thing, kind, made.pictures, palette)
                mesh.materials.append(kinds[kind])
            baked = bpy.data.objects.new(name, mesh)
            baked.matrix_world = thing.matrix_world.copy()
            wind.copy(thing, baked)
            # All levels are in one place: only the finest is seen.
            baked.hide_render = number > 0
            collection.objects.link(baked)
            baked.hide_set(number > 0)
        self.report({"INFO"}, ", ".join(f"{one.name}: {len(one.data.polygons)}" for one in collection.objects) + " triangles")


def _material(thing: Any, kind: str, pictures: dict[str, Any], palette: dict[str, Any]) -> Any:
    name = f"{thing.name} {kind} baked"
    if kind in pictures:
        return materials.with_pictures(name, pictures[kind], cut_out=kind != "bark")
    color = palette[{"leaves": "leaf", "twigs": "leaf"}.get(kind, kind)]
    return materials.ensure(None, name, kind, color)


def budgets(text: str) -> list[int]:
    """The numbers of a text such as ``30000, 8000``. Raises ``pleach.PleachError``."""
    words = text.replace(",", " ").split()
    if not all(word.isascii() and word.isdigit() for word in words) or not words:
        raise library.pleach.PleachError(f"`{text}` is no list of whole numbers, such as 30000, 8000, 2000")
    return [int(word) for word in words]


CLASSES = (PLEACH_OT_load, PLEACH_OT_save, PLEACH_OT_bake)
