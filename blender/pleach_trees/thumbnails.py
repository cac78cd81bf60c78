"""Pictures of the species, which were painted when the extension was built."""

from __future__ import annotations

import pathlib
from typing import Any

import bpy.utils.previews

from . import library

FOLDER = pathlib.Path(__file__).parent / "thumbnails"

#: Stands for the species of the active tree.
ACTIVE = "ACTIVE"

_pictures: Any = None
# Blender keeps no reference to the texts of dynamic items.
_items: list[Any] = []
_starts: list[Any] = []


def items() -> list[Any]:
    """All species as items of a list, with their pictures; by family, the dissertation's first."""
    if not _items and library.pleach:
        for number, name in enumerate(library.pleach.species()):
            _items.append((name, name.replace("_", " ").capitalize(), "", icon(name), number))
    return _items or [("NONE", "No species", "", 0, 0)]


def items_to_start_from() -> list[Any]:
    """The same after the active tree."""
    if not _starts:
        active = (ACTIVE, "The active tree", "The species of the active tree, as its sliders say", "OBJECT_DATA", 0)
        _starts.extend([active, *((*item[:4], item[4] + 1) for item in items() if item[0] != "NONE")])
    return _starts


def icon(name: str) -> int:
    """The number of the picture of a species; 0 where there is none."""
    if _pictures is None:
        return 0
    if name not in _pictures:
        file = FOLDER / f"{name}.png"
        if not file.exists():
            return 0
        _pictures.load(name, str(file), "IMAGE")
    return _pictures[name].icon_id


def register() -> None:
    global _pictures
    _pictures = bpy.utils.previews.new()


def unregister() -> None:
    global _pictures
    bpy.utils.previews.remove(_pictures)
    _pictures = None
    _items.clear()
    _starts.clear()
