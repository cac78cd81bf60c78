"""Wind: modifiers that move a tree as the time of the scene goes on.

The modifier of the tree's own object has the settings. Those of its leaves, blossoms, foliage and bark follow it by drivers,
so that one may animate them, and so that a file moves where the extension is not installed.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from . import nodes, wind_nodes
from .wind_data import drop_wind, put_wind

WIND = "pleach wind"

#: Inputs of the modifier that are the user's.
SETTINGS = ("Strength", "Direction")
#: Where an object remembers them while it has no wind.
KEPT = "pleach_wind"


def modifier_of(thing: Any) -> Any:
    """The modifier that moves the tree of an object; `None` in still air."""
    return thing.modifiers.get(WIND)


def add(thing: Any) -> None:
    """A modifier that moves the tree of an object, with the settings of the last one if there was one; ``fill`` has to follow."""
    if modifier_of(thing) is not None:
        return
    modifier = _first(thing, wind_nodes.stems)
    for name, value in zip(SETTINGS, thing.get(KEPT, ())):
        nodes.set_input(modifier, name, value)


def remove(thing: Any) -> None:
    """Still air."""
    modifier = modifier_of(thing)
    if modifier is None:
        return
    values = [nodes.get_input(modifier, name) for name in SETTINGS]
    # A group of the user's own may have no such inputs.
    if None not in values:
        thing[KEPT] = values
    for one in (*thing.children, thing):
        found = one.modifiers.get(WIND)
        if found is None:
            continue
        # Its drivers go with it.
        one.modifiers.remove(found)
        # A linked copy still reads them.
        if one is not thing and one.data.users == 1:
            drop_wind(one.data)


def fits(thing: Any, tree: Any) -> bool:
    """Whether the parts of an object have the points of its tree, as they have unless they were edited."""
    counts = {"leaves": len(tree.leaf_positions), "blossom": len(tree.blossom_positions)}
    for one in thing.children:
        kind = one.get("pleach_part")
        if kind in counts and len(one.data.vertices) > counts[kind]:
            return False
        if kind == "foliage" and len(one.data.vertices) != len(tree.blob_vertices):
            return False
    return True


def fill(thing: Any, tree: Any) -> None:
    """Gives all parts of a tree what its wind needs, if there is any."""
    modifier = modifier_of(thing)
    if modifier is None:
        return
    nodes.set_input(modifier, "Height", max(float(tree.bounds[1, 2]), 0.001))
    for one in thing.children:
        kind = one.get("pleach_part")
        if kind == "leaves":
            put_wind(one.data, [tree.wind("leaves")], rows=slice(len(one.data.vertices)))
        elif kind == "blossom":
            put_wind(one.data, [tree.wind("blossoms")], rows=slice(len(one.data.vertices)))
        elif kind == "foliage":
            put_wind(one.data, [tree.wind("blobs")], rows=_blob_of_vertex(tree))
        # Bark as a mesh has its numbers from the library.
        elif kind != "bark":
            continue
        _follow(one, thing, wind_nodes.leaves if kind in ("leaves", "blossom") else wind_nodes.meshes)


def _follow(one: Any, thing: Any, make: Any) -> None:
    """Moves an object by the wind of the tree of another one."""
    modifier, leader = _first(one, make), modifier_of(thing)
    theirs = {item.name: item for item in _inputs(leader)}
    for item in _inputs(modifier):
        if item.name not in theirs or _driver(one, _path(item)) is not None:
            continue
        driver = one.driver_add(_path(item)).driver
        driver.type = "SUM"
        variable = driver.variables.new()
        variable.targets[0].id = thing
        variable.targets[0].data_path = _path(theirs[item.name])


def copy(thing: Any, mesh: Any) -> None:
    """The same wind, if there is some, for a mesh of the tree that stands by itself."""
    leader = modifier_of(thing)
    if leader is None:
        return
    modifier = _first(mesh, wind_nodes.meshes)
    copy_settings(leader, modifier)
    height = nodes.get_input(leader, "Height")
    if height is not None:
        nodes.set_input(modifier, "Height", height)


def copy_settings(leader: Any, modifier: Any) -> None:
    """Sets one modifier as another one is."""
    for name in SETTINGS:
        value = nodes.get_input(leader, name)
        if value is not None:
            nodes.set_input(modifier, name, value)


def _blob_of_vertex(tree: Any) -> Any:
    firsts = tree.blob_first_vertices.astype(np.int64)
    return np.repeat(np.arange(len(firsts)), np.diff(firsts, append=len(tree.blob_vertices)))


def _first(one: Any, make: Any) -> Any:
    """The modifier of wind, above all others when it is made."""
    is_new = WIND not in one.modifiers
    modifier = nodes.modifier_of(one, WIND, make)
    if is_new:
        one.modifiers.move(len(one.modifiers) - 1, 0)
    return modifier


def _inputs(modifier: Any) -> list[Any]:
    """The numbers of a modifier that can be driven."""
    group = modifier.node_group
    items = group.interface.items_tree if group else ()
    return [item for item in items if item.item_type == "SOCKET" and item.in_out == "INPUT" and item.socket_type == "NodeSocketFloat"]


def _path(item: Any) -> str:
    return f'modifiers["{WIND}"]["{item.identifier}"]'


def _driver(one: Any, path: str) -> Any:
    drivers = one.animation_data.drivers if one.animation_data else ()
    return next((driver for driver in drivers if driver.data_path == path), None)
