"""The map of species: a plane on which every point is a tree, and the picture of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import bpy

from . import library, materials

#: The image that shows the map.
IMAGE = "pleach map"
#: The part of the plane that sliders reach without typing: the least and the greatest coordinates, a little beyond all species.
LOW, HIGH = (-2.0, -1.5), (1.5, 2.5)

_map: list[Any] = []


def of_species() -> Any:
    """The map of the fifteen species of Hewitt's dissertation, made when it is first needed."""
    if not _map:
        _map.append(library.pleach.Map())
    return _map[0]


def forget() -> None:
    """Drops what is kept."""
    _map.clear()


def image() -> Any:
    """The picture of the map as an image of the file; it is made where the file has none."""
    found = bpy.data.images.get(IMAGE)
    return found or materials.picture(IMAGE, of_species().picture(), True)


def point_at(across: float, up: float) -> tuple[float, float] | None:
    """The point of the map that its picture shows there: 0 to 1 from the left, and 0 to 1 from the foot; `None` outside its frame."""
    width, height = image().size
    point = of_species().point_at(across * width, (1.0 - up) * height)
    low, high = of_species().extent
    return point if all(low <= point) and all(point <= high) else None


@dataclass(frozen=True)
class Place:
    """The tree at a point of the map."""

    species: Any
    words: str
    """What it is made of, such as `60 % acer, 40 % palm`."""


def at(x: float, y: float) -> Place:
    """The tree at a point, called after the species that it has most of."""
    found = of_species().at(x, y)
    shares = sorted(found.shares.items(), key=lambda share: -share[1])
    shares = [(name, share) for name, share in shares if share >= 0.005]
    name = "_".join(name for name, _ in shares[:2])[:60]
    words = ", ".join(f"{100 * share:.0f} % {name.replace('_', ' ')}" for name, share in shares)
    return Place(found.species.named(name), f"{words}, and beyond them" if found.outside > 0.01 else words)


def locate(species: Any) -> tuple[float, float] | None:
    """Where a species belongs; `None` where it does not grow as those of the map do."""
    return of_species().locate(species) if species.generator == family() else None


def family() -> str:
    """What the species of the map grow by."""
    return str(of_species().species[0].generator)
