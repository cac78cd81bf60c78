"""From a grown tree to objects of the scene, and the same objects with another tree.

An object of curves is the tree: it has the species, the seed and the sliders. Leaves, blossoms, foliage and a mesh of
bark are its children. Growing again replaces data and keeps objects, modifiers, materials and what a user has put into
the collections of shapes.
"""

from __future__ import annotations

from typing import Any

import bpy

from . import curves, library, materials, meshes, nodes, plane, shapes, sliders, wind
from .wind_data import has_wind, put_wind

BARK, LEAVES = "pleach bark", "pleach leaves"

#: Seasons by the values of the property, where None is the species file's own.
SEASONS = {"SPECIES": None, "SPRING": "spring", "SUMMER": "summer", "AUTUMN": "autumn", "WINTER": "winter"}


def new(context: Any, species: Any, seed: int | None = None) -> Any:
    """Grows a tree into a collection of its own, at the cursor; returns its object. Raises ``pleach.PleachError``."""
    tree = species.grow(seed)
    name = species.name
    collection = bpy.data.collections.new(name)
    context.scene.collection.children.link(collection)
    thing = bpy.data.objects.new(name, bpy.data.hair_curves.new(name))
    thing.location = context.scene.cursor.location
    collection.objects.link(thing)
    with sliders.silently():
        state = thing.pleach
        state.is_tree = True
        state.seed = min(tree.seed, library.MAX_SEED)
    fill(thing, species, tree)
    for other in list(context.view_layer.objects.selected):
        other.select_set(False)
    thing.select_set(True)
    context.view_layer.objects.active = thing
    return thing


def regrow(thing: Any, species: Any | None = None) -> None:
    """Grows the tree of an object again: of ``species``, or as its sliders say. Raises ``pleach.PleachError``."""
    state = thing.pleach
    if species is None:
        species = library.species_of(state.species_text)
        changed = sliders.changes(thing, species)
        if changed:
            species = species.replace(changed)
    fill(thing, species, species.grow(state.seed))


def fill(thing: Any, species: Any, tree: Any) -> None:
    """Puts a tree into its objects."""
    state = thing.pleach
    with sliders.silently():
        state.species_text = species.to_toml()
        state.species_name = species.name
        state.format = 1
        state.map_x, state.map_y = plane.locate(species) or (0.0, 0.0)
    sliders.show(thing, species)
    palette = species.palette(SEASONS[state.season])
    _fill_curves(thing, tree, palette)
    leaves = len(tree.leaf_positions) if palette["leaves"] else 0
    blossoms = len(tree.blossom_positions) if palette["blossoms"] else 0
    _fill_points(thing, "leaves", shapes.outlines(tree), palette["leaf"], (
        tree.leaf_positions[:leaves], tree.leaf_along[:leaves], tree.leaf_across[:leaves], tree.leaf_shapes[:leaves]))
    _fill_points(thing, "blossom", shapes.blossoms(tree), palette["blossom"], (
        tree.blossom_positions[:blossoms], tree.blossom_along[:blossoms], tree.blossom_across[:blossoms],
        tree.blossom_shapes[:blossoms]))
    _fill_blobs(thing, tree, palette)
    wind.fill(thing, tree)
    state.leaf_count, state.stem_count = leaves + blossoms, len(tree.levels)


def child(thing: Any, kind: str) -> Any:
    """The child of a tree's object that is of this kind, or None."""
    return next((one for one in thing.children if one.get("pleach_part") == kind), None)


def _ensure_child(thing: Any, kind: str, mesh: Any) -> Any:
    """The child of this kind with this mesh, whose materials are those of the mesh before."""
    found = child(thing, kind)
    if found is None:
        found = bpy.data.objects.new(f"{thing.name} {kind}", mesh)
        found["pleach_part"] = kind
        found.parent = thing
        for collection in thing.users_collection:
            collection.objects.link(found)
        return found
    replace_data(found, mesh, bpy.data.meshes)
    return found


def replace_data(thing: Any, data: Any, blocks: Any) -> None:
    """Gives an object other data with the materials and the name of those before, which go if nobody else has them."""
    before = thing.data
    for material in before.materials:
        data.materials.append(material)
    name = before.name
    thing.data = data
    if not before.users:
        blocks.remove(before)
    data.name = name


def _fill_curves(thing: Any, tree: Any, palette: dict[str, Any]) -> None:
    state = thing.pleach
    stems = curves.of_tree(thing.name, tree, roots=state.roots)
    # So few numbers are always there: edits stay when wind is switched on later.
    put_wind(stems, [tree.wind()], "CURVE", curves.shown(tree, roots=state.roots))
    replace_data(thing, stems, bpy.data.hair_curves)
    modifier = nodes.modifier_of(thing, BARK, nodes.bark)
    material = nodes.get_input(modifier, "Material")
    made = materials.ensure(material, f"{thing.name} bark", "bark", palette["bark"])
    if made is not material:
        nodes.set_input(modifier, "Material", made)
    if not thing.data.materials:
        thing.data.materials.append(made)
    nodes.set_input(modifier, "Show", state.bark == "CURVES")
    if state.bark == "MESH":
        _fill_bark(thing, tree)
    else:
        _remove_child(thing, "bark")


def _fill_bark(thing: Any, tree: Any) -> None:
    """Bark as a mesh, with the texture coordinates and, where they are asked for, the pictures of the library."""
    state = thing.pleach
    options = {"leaves": "none", "tolerance": state.tolerance, "roots": state.roots, "wind": state.wind}
    has_pictures = state.textures != "NONE"
    made = tree.mesh(**options, **({"textures": int(state.textures)} if has_pictures else {}))
    parts = {name: part for name, part in made.levels[0].items() if name == "bark"}
    if not parts:
        _remove_child(thing, "bark")
        return
    mesh, _ = meshes.of_parts(f"{thing.name} bark", parts)
    bark = _ensure_child(thing, "bark", mesh)
    if bark.data.materials and bark.get("pleach_textures") == state.textures:
        return
    bark["pleach_textures"] = state.textures
    bark.data.materials.clear()
    if has_pictures:
        bark.data.materials.append(materials.with_pictures(f"{thing.name} bark", made.pictures["bark"], cut_out=False))
    else:
        bark.data.materials.append(nodes.get_input(thing.modifiers[BARK], "Material"))


def _fill_points(thing: Any, kind: str, forms: list[Any], color: tuple[int, int, int], parts: tuple[Any, ...]) -> None:
    """Points that leaves or blossoms are put on. A tree that never had any has no such child."""
    if not len(parts[0]) and child(thing, kind) is None:
        return
    carrier = _ensure_child(thing, kind, meshes.points(f"{thing.name} {kind}", *parts))
    modifier = nodes.modifier_of(carrier, LEAVES, nodes.leaves)
    collection = nodes.get_input(modifier, "Shapes")
    if not forms:
        return
    filled = shapes.fill(collection, thing.name, kind, forms, color)
    if filled is not collection:
        nodes.set_input(modifier, "Shapes", filled)
    nodes.set_input(modifier, "Viewport Share", thing.pleach.leaf_share)


def _fill_blobs(thing: Any, tree: Any, palette: dict[str, Any]) -> None:
    if not palette["leaves"] or not len(tree.blob_vertices):
        _remove_child(thing, "foliage")
        return
    made = meshes.triangles(f"{thing.name} foliage", tree.blob_vertices, tree.blob_triangles)
    blobs = _ensure_child(thing, "foliage", made)
    material = blobs.data.materials[0] if blobs.data.materials else None
    ours = materials.ensure(material, f"{thing.name} foliage", "foliage", palette["leaf"])
    if material is None:
        blobs.data.materials.append(ours)


def _remove_child(thing: Any, kind: str) -> None:
    found = child(thing, kind)
    if found is not None:
        mesh = found.data
        bpy.data.objects.remove(found)
        if not mesh.users:
            bpy.data.meshes.remove(mesh)


def set_share(thing: Any) -> None:
    """How many leaves the viewport shows, without growing again."""
    for kind in ("leaves", "blossom"):
        carrier = child(thing, kind)
        if carrier is not None and LEAVES in carrier.modifiers:
            nodes.set_input(carrier.modifiers[LEAVES], "Viewport Share", thing.pleach.leaf_share)


def set_wind(thing: Any, on: bool) -> None:
    """Wind for the tree of an object, or still air; its curves stay as they are. Raises ``pleach.PleachError``."""
    if not on:
        wind.remove(thing)
        return
    state = thing.pleach
    tree = library.species_of(state.species_text).grow(state.seed)
    rows = curves.shown(tree, roots=state.roots)
    if not wind.fits(thing, tree) or not has_wind(thing.data) and int(rows.sum()) != len(thing.data.curves):
        raise library.pleach.PleachError("edited parts do not know how they move: press Grow Again, then tick Wind")
    if not has_wind(thing.data):
        put_wind(thing.data, [tree.wind()], "CURVE", rows)
    wind.add(thing)
    if state.bark == "MESH":
        _fill_bark(thing, tree)
    wind.fill(thing, tree)
