"""Stems as editable Bézier curves."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np


def of_tree(name: str, tree: Any, *, roots: bool) -> Any:
    """The stems of a tree as a new block of curves: radius by point; level, parent and base_radius by curve."""
    counts = tree.knot_counts.astype(np.int32)
    stems = shown(tree, roots=roots)
    knots = np.repeat(stems, counts)
    # Parents by the numbers of the curves that are kept; a root of a root is left out with its parent.
    number = np.where(stems, np.cumsum(stems) - 1, -1)
    parents = tree.parents
    parents = np.where(parents >= 0, number[np.maximum(parents, 0)], -1)[stems]
    curves = bpy.data.hair_curves.new(name)
    if not stems.any():
        return curves
    curves.add_curves([int(count) for count in counts[stems]])
    # Writing the types by hand ends Blender.
    curves.set_types(type="BEZIER")
    put(curves, "position", "FLOAT_VECTOR", "POINT", tree.knots[knots])
    put(curves, "handle_left", "FLOAT_VECTOR", "POINT", tree.handles_in[knots])
    put(curves, "handle_right", "FLOAT_VECTOR", "POINT", tree.handles_out[knots])
    radii = tree.radii
    put(curves, "radius", "FLOAT", "POINT", radii[knots])
    put(curves, "level", "INT", "CURVE", tree.levels[stems])
    put(curves, "parent", "INT", "CURVE", parents)
    put(curves, "base_radius", "FLOAT", "CURVE", radii[tree.first_knots[stems]])
    return curves


def shown(tree: Any, *, roots: bool) -> Any:
    """Which stems of a tree are curves, bool of shape (stems,)."""
    if roots:
        return np.ones(len(tree.levels), bool)
    return np.array([kind != "root" for kind in tree.kinds], bool)


def put(data: Any, name: str, kind: str, domain: str, values: Any) -> None:
    """Writes an attribute of a mesh or of curves; it is added where there is none."""
    attribute = data.attributes.get(name) or data.attributes.new(name, kind, domain)
    of_kind = np.int32 if kind == "INT" else np.float32
    field = "vector" if kind in ("FLOAT_VECTOR", "FLOAT2") else "value"
    attribute.data.foreach_set(field, np.ascontiguousarray(values, of_kind).ravel())
