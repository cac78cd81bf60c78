"""What an object knows of its tree, and what the panel is set to."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from . import library, plane, result, sliders, thumbnails, wind

#: What the last growth of each object said, by its session number: shown in the panel.
problems: dict[int, str] = {}


def grow_again(thing: Any, species: Any | None = None) -> bool:
    """Grows the tree of an object; tells whether it grew. What is wrong is kept for the panel."""
    if not library.pleach or not thing.pleach.is_tree:
        return False
    # Data that another scene file owns, or that is being edited, cannot be replaced.
    if thing.library or thing.mode != "OBJECT":
        problems[thing.session_uid] = "leave edit mode, or make the object local, to grow the tree again"
        return False
    try:
        result.regrow(thing, species)
    except library.pleach.PleachError as error:
        problems[thing.session_uid] = str(error)
        return False
    problems.pop(thing.session_uid, None)
    return True


def _changed(state: Any, _context: Any) -> None:
    if not sliders._silent[0] and state.is_tree:
        grow_again(state.id_data)


def _has_wind(state: Any) -> bool:
    return wind.modifier_of(state.id_data) is not None


def _set_wind(state: Any, on: bool) -> None:
    thing = state.id_data
    if not library.pleach or not state.is_tree:
        return
    if thing.library or thing.mode != "OBJECT":
        problems[thing.session_uid] = "leave edit mode, or make the object local, to change its wind"
        return
    try:
        result.set_wind(thing, on)
    except library.pleach.PleachError as error:
        problems[thing.session_uid] = str(error)
        return
    problems.pop(thing.session_uid, None)


def _placed(state: Any, _context: Any) -> None:
    if sliders._silent[0] or not library.pleach or not state.is_tree:
        return
    x, y = state.map_x, state.map_y
    if grow_again(state.id_data, plane.at(x, y).species):
        with sliders.silently():
            state.map_x, state.map_y = x, y


def _shared(state: Any, _context: Any) -> None:
    if state.is_tree:
        result.set_share(state.id_data)


class PLEACH_PG_lock(bpy.types.PropertyGroup):
    """A slider that the dice leave alone; its name is that of the number."""


#: Pixels a side of pictures.
TEXTURES = [("NONE", "None", ""), ("512", "512 pixels", ""), ("1024", "1024 pixels", ""), ("2048", "2048 pixels", "")]


class PLEACH_PG_tree(bpy.types.PropertyGroup):
    """A tree; on the object that its stems are."""

    is_tree: BoolProperty(options={"HIDDEN"})
    format: IntProperty(options={"HIDDEN"}, description="Which version of the extension wrote this")
    species_text: StringProperty(options={"HIDDEN"}, description="The text of the species file")
    species_name: StringProperty(options={"HIDDEN"})
    leaf_count: IntProperty(options={"HIDDEN"})
    stem_count: IntProperty(options={"HIDDEN"})
    locks: CollectionProperty(type=PLEACH_PG_lock)
    seed: IntProperty(name="Seed", description="Which tree of the species: each number is another one", default=1, min=0,
                      max=library.MAX_SEED, update=_changed)
    season: EnumProperty(
        name="Season",
        description="Colour of the leaves, and what the tree wears",
        items=[
            ("SPECIES", "As the species says", "Summer, unless the species file says something else"),
            ("SPRING", "Spring", "Young leaves, all blossom"),
            ("SUMMER", "Summer", "Full leaf, no blossom"),
            ("AUTUMN", "Autumn", "Turning leaves"),
            ("WINTER", "Winter", "Bare, unless the species is evergreen"),
        ],
        update=_changed,
    )
    leaf_share: FloatProperty(name="Leaves in viewport", description="Part of the leaves that the viewport shows; renders show all",
                              default=1.0, min=0.0, max=1.0, subtype="FACTOR", update=_shared)
    # The modifier says whether there is wind, so that one may take it away by hand.
    wind: BoolProperty(name="Wind", description="Whether the tree moves as the time of the scene goes on", get=_has_wind, set=_set_wind)
    map_x: FloatProperty(name="To the right", description="Where the tree is on the map of species; moving it makes it the tree of "
                                                         "the map there", soft_min=plane.LOW[0], soft_max=plane.HIGH[0], step=5,
                         precision=2, update=_placed)
    map_y: FloatProperty(name="Upwards", description="Where the tree is on the map of species; moving it makes it the tree of the map "
                                                    "there", soft_min=plane.LOW[1], soft_max=plane.HIGH[1], step=5, precision=2,
                         update=_placed)
    roots: BoolProperty(name="Roots", description="Whether roots are there, where the species has some", update=_changed)
    bark: EnumProperty(
        name="Bark",
        description="What bark is made of",
        items=[
            ("CURVES", "Curves", "Geometry Nodes put bark around the curves, which you may edit"),
            ("MESH", "Mesh", "A mesh with the library's texture coordinates; it does not follow edits of the curves"),
        ],
        update=_changed,
    )
    tolerance: FloatProperty(name="Tolerance", description="How far the mesh may stray from the true surface, in millimetres",
                             default=2.0, min=0.01, max=1000.0, soft_max=50.0, update=_changed)
    textures: EnumProperty(
        name="Textures",
        description="Pictures of the bark: colour, normals and roughness",
        items=TEXTURES,
        update=_changed,
    )


def _species_items(_self: Any, _context: Any) -> list[Any]:
    return thumbnails.items()


def _start_items(_self: Any, _context: Any) -> list[Any]:
    return thumbnails.items_to_start_from()


class PLEACH_PG_panel(bpy.types.PropertyGroup):
    """What the panel is set to; kept in the scene."""

    species: EnumProperty(name="Species", description="The species to grow", items=_species_items)
    blend_from: EnumProperty(name="Species", description="The species to start from", items=_start_items)
    blend_with: EnumProperty(name="Other", description="The species to go towards; one of the same family", items=_species_items)
    blend: FloatProperty(name="Share", description="How much of the other species", default=0.5, min=0.0, max=1.0, subtype="FACTOR")
    spread: FloatProperty(name="Spread", description="How far the dice may move a slider, as a part of its usual range", default=0.2,
                          min=0.0, max=1.0, subtype="FACTOR")
    picture: PointerProperty(name="Picture", description="The picture of a tree to fit", type=bpy.types.Image)
    height: FloatProperty(name="Height", description="How high the tree in the picture is, in metres", default=10.0, min=0.1, max=150.0)
    seconds: FloatProperty(name="Time", description="Seconds that the fit may take", default=60.0, min=1.0, max=86400.0,
                           soft_max=600.0)
    family: EnumProperty(
        name="Family",
        description="The kind of generator that is searched",
        items=[
            ("AUTO", "By the picture", "Trees for photographs, stylised trees for drawings, Weber and Penn for silhouettes"),
            ("weber-penn", "Weber and Penn", ""),
            ("space-colonization", "Space colonisation", ""),
            ("stylised", "Stylised", ""),
            ("fractal", "Fractal", ""),
            ("least-cost-path", "Least-cost paths", ""),
        ],
    )
    very_tree: BoolProperty(name="This very tree", description="Whether branches are laid on those of the picture; otherwise the "
                                                             "result is the kind of tree", default=True)
    open_group: StringProperty(options={"HIDDEN"})
    budgets: StringProperty(name="Triangles", description="How many triangles each level has, the largest first",
                            default="30000, 8000, 2000")
    bake_textures: EnumProperty(
        name="Textures", description="Pictures of the bark of baked meshes",
        items=TEXTURES,
        default="1024",
    )


CLASSES = (PLEACH_PG_lock, PLEACH_PG_tree, PLEACH_PG_panel)


def tree_of(context: Any) -> Any:
    """The object of the tree that is active, or whose part is; None without any."""
    return tree_with(context.active_object)


def tree_with(thing: Any) -> Any:
    """The object of the tree that an object is, or is a part of; `None` where it is of no tree."""
    while thing is not None and not thing.pleach.is_tree:
        thing = thing.parent
    return thing


@bpy.app.handlers.persistent
def on_load(*_: Any) -> None:
    """Registers the sliders of the trees of a file that was opened, and puts them where the species are."""
    problems.clear()
    if not library.pleach:
        return
    for thing in bpy.data.objects:
        # Those that another file owns cannot be written to.
        if not thing.pleach.is_tree or thing.library:
            continue
        try:
            sliders.show(thing, library.species_of(thing.pleach.species_text))
        except library.pleach.PleachError as error:
            problems[thing.session_uid] = f"the species of this tree is not known to this version: {error}"


def register() -> None:
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.Object.pleach = PointerProperty(type=PLEACH_PG_tree)
    bpy.types.Scene.pleach = PointerProperty(type=PLEACH_PG_panel)
    bpy.app.handlers.load_post.append(on_load)


def unregister() -> None:
    bpy.app.handlers.load_post.remove(on_load)
    sliders.unregister()
    plane.forget()
    del bpy.types.Scene.pleach
    del bpy.types.Object.pleach
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
    problems.clear()
