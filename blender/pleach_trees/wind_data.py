"""The numbers by which wind moves curves, meshes and leaves, as attributes."""

from __future__ import annotations

from typing import Any, Sequence

import numpy as np

from .curves import put

#: Names of attributes, where a ``pleach.Wind`` has them, and their kinds.
_NUMBERS = (
    ("wind_pivot", "pivots", "FLOAT_VECTOR"),
    ("wind_bend", "bends", "FLOAT_VECTOR"),
    ("wind_phase", "phases", "FLOAT"),
    ("wind_parent_pivot", "parent_pivots", "FLOAT_VECTOR"),
    ("wind_parent_bend", "parent_bends", "FLOAT_VECTOR"),
    ("wind_parent_phase", "parent_phases", "FLOAT"),
    ("wind_level", "levels", "FLOAT"),
    ("wind_flutter", "flutters", "FLOAT"),
)


def put_wind(data: Any, winds: Sequence[Any], domain: str = "POINT", rows: Any = None) -> None:
    """Writes the rows of one ``pleach.Wind`` after the other to a mesh or to curves; all rows, or these."""
    for name, field, kind in _NUMBERS:
        values = np.concatenate([getattr(wind, field) for wind in winds])
        put(data, name, kind, domain, values if rows is None else values[rows])


def has_wind(data: Any) -> bool:
    """Whether the numbers are there."""
    return _NUMBERS[0][0] in data.attributes


def drop_wind(data: Any) -> None:
    """Takes the numbers away."""
    for name, _, _ in _NUMBERS:
        attribute = data.attributes.get(name)
        if attribute is not None:
            data.attributes.remove(attribute)
