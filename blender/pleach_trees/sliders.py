"""Sliders, made from what is declared about the parameters of a species.

All species whose parameters are declared alike share one class of sliders. It is registered when a tree of such a
species is first seen.
"""

from __future__ import annotations

import hashlib
import json
import re
from dataclasses import dataclass
from typing import Any, Callable

import bpy
from bpy.props import EnumProperty, FloatProperty, IntProperty, PointerProperty

from . import library


@dataclass(frozen=True)
class Slider:
    """One number of a species."""

    prop: str
    """Its name as a property."""
    key: str
    """Its name in the species, such as ``length[1]``."""
    parameter: str
    group: str
    choices: tuple[str, ...]
    """What it may be, where it is a choice."""
    whole: bool
    soft: tuple[float, float]
    hard: tuple[float, float]
    log: bool
    handle: str
    """What artists call it, if it is one of the few that they want first."""
    order: int
    """Its place among those."""


@dataclass(frozen=True)
class Space:
    """The sliders of a species."""

    attribute: str
    """The property of objects that holds them."""
    sliders: tuple[Slider, ...]
    groups: tuple[str, ...]


_spaces: dict[str, tuple[Space, Any]] = {}
_of_species: dict[Any, Space] = {}
_changed: list[Callable[[Any], None]] = []
_silent = [False]


def first_of(space: Space) -> list[Slider]:
    """The sliders that are shown first, with names of their own: height, crown, density, leaves."""
    return sorted((slider for slider in space.sliders if slider.handle), key=lambda slider: slider.order)


def space_of(species: Any) -> Space:
    """The sliders of a species; their class is registered if it is not yet. Not to be called while drawing."""
    key = (species.generator, tuple(species.slots))
    known = _of_species.get(key)
    if known is None:
        known = _of_species[key] = _space(species)
    return known


def known_space(species: Any) -> Space | None:
    """The sliders of a species, if their class is registered."""
    return _of_species.get((species.generator, tuple(species.slots)))


def _space(species: Any) -> Space:
    declared = species.declared()
    text = json.dumps([species.generator, declared], sort_keys=True)
    digest = hashlib.sha1(text.encode()).hexdigest()[:10]
    attribute = f"pleach_{digest}"
    if attribute in _spaces:
        return _spaces[attribute][0]
    sliders, annotations = [], {}
    for name, about in declared.items():
        for slot in about["slots"]:
            slider = _slider(name, about, slot)
            sliders.append(slider)
            annotations[slider.prop] = _property(slider, about)
    groups = tuple(dict.fromkeys(slider.group for slider in sliders))
    space = Space(attribute, tuple(sliders), groups)
    kind = type(f"PLEACH_PG_{digest}", (bpy.types.PropertyGroup,), {"__annotations__": annotations})
    bpy.utils.register_class(kind)
    setattr(bpy.types.Object, attribute, PointerProperty(type=kind))
    _spaces[attribute] = (space, kind)
    return space


def _slider(name: str, about: dict[str, Any], slot: dict[str, Any]) -> Slider:
    key = slot["slot"]
    hard = (about["min"], about["max"])
    soft = tuple(slot["search"] or hard)
    handle = slot["handle"] or {"name": "", "order": 0}
    return Slider(
        prop=re.sub(r"\W+", "_", key).strip("_"),
        key=key,
        parameter=name,
        group=about["group"] or "other",
        choices=tuple(about["choices"] or ()),
        whole="integer" in about["kind"],
        soft=soft if soft[0] < soft[1] else hard,
        hard=hard,
        log=slot["scale"] == "log",
        handle=handle["name"].capitalize(),
        order=handle["order"],
    )


def _property(slider: Slider, about: dict[str, Any]) -> Any:
    words = about["doc"]
    if about.get("negative"):
        words += f"; negative: {about['negative']}"
    if about.get("unit") not in (None, "", "count", "ratio"):
        words += f" ({about['unit']})"
    common = {"name": label(slider.key), "description": words, "update": _on_change}
    if slider.choices:
        items = [(choice, choice.replace("_", " ").capitalize(), "") for choice in slider.choices]
        return EnumProperty(items=items, **common)
    low, high = slider.hard
    if slider.whole:
        bounds = {"min": max(int(low), -(2**31)), "max": min(int(high), 2**31 - 1)}
        return IntProperty(**bounds, soft_min=int(slider.soft[0]), soft_max=int(slider.soft[1]), **common)
    step = max((slider.soft[1] - slider.soft[0]), 1e-3)
    return FloatProperty(min=low, max=high, soft_min=slider.soft[0], soft_max=slider.soft[1], step=step, precision=3, **common)


def label(key: str) -> str:
    """A number's name as people read it: ``length[1]`` becomes ``Length 1``."""
    return re.sub(r"\[(\d+)\]", r" \1", key).replace("_", " ").capitalize()


def _on_change(group: Any, _context: Any) -> None:
    if not _silent[0]:
        for tell in _changed:
            tell(group.id_data)


def on_change(tell: Callable[[Any], None]) -> None:
    """Calls ``tell`` with the object whose sliders a user moves."""
    _changed[:] = [tell]


class silently:
    """While this lasts, changed sliders grow nothing."""

    def __enter__(self) -> None:
        self.before = _silent[0]
        _silent[0] = True

    def __exit__(self, *_: object) -> None:
        _silent[0] = self.before


def flat(species: Any) -> dict[str, Any]:
    """All numbers of a species by key."""
    values: list[Any] = []
    for value in species.values():
        values.extend(value if isinstance(value, tuple) else [value])
    return dict(zip(species.slots, values))


def show(thing: Any, species: Any) -> None:
    """Puts the sliders of an object where the numbers of the species are."""
    space = space_of(species)
    group, values = getattr(thing, space.attribute), flat(species)
    with silently():
        for slider in space.sliders:
            setattr(group, slider.prop, values[slider.key])


def changes(thing: Any, species: Any) -> dict[str, Any]:
    """What the sliders of an object say otherwise than the species."""
    space = space_of(species)
    group, values = getattr(thing, space.attribute), flat(species)
    found = {}
    for slider in space.sliders:
        now, before = getattr(group, slider.prop), values[slider.key]
        if slider.choices or slider.whole:
            if now != before:
                found[slider.key] = now
        # Sliders hold seven digits.
        elif abs(now - before) > 1e-6 * max(abs(now), abs(before)):
            found[slider.key] = float(f"{now:.7g}")
    return found


def unregister() -> None:
    """Takes all classes back."""
    for attribute, (_, kind) in _spaces.items():
        delattr(bpy.types.Object, attribute)
        bpy.utils.unregister_class(kind)
    _spaces.clear()
    _of_species.clear()
    _changed.clear()
    library.forget()
