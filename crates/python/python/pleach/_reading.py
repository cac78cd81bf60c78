"""What is in a picture of a tree."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._goal import Goal, given
from ._score import Point, hints


@dataclass(frozen=True)
class Reading:
    """What is in a picture of a tree."""

    measures: dict[str, Any]
    """The measures, as in the program's ``reading.json``: ``feet``, ``trunk``, ``lean_deg``, ``first_fork``,
    ``bare_height``, ``crown``, …, each with its ``…_confidence``. Lengths are in heights of the tree."""
    ink: npt.NDArray[np.bool_]
    """Bool of shape (height, width), True where the tree is."""
    annotated: npt.NDArray[np.uint8]
    """The measures drawn over the tree: uint8 of shape (height, width, 3)."""

    def __getitem__(self, name: str) -> Any:
        return self.measures[name]


def corrections(reading: Union[Reading, Mapping[str, Any], None]) -> dict[str, Any]:
    """What is otherwise than it is read, as the library takes it."""
    return dict(reading.measures if isinstance(reading, Reading) else reading or {})


def read(
    picture: Goal,
    *,
    mask: Optional[str] = None,
    box: Optional[tuple[int, int, int, int]] = None,
    include: Sequence[Point] = (),
    exclude: Sequence[Point] = (),
    strokes: Optional[str] = None,
    wood: Optional[Goal] = None,
    reading: Union[Reading, Mapping[str, Any], None] = None,
    tree: str = "auto",
) -> Reading:
    """Reads what is in a picture of a tree: how many trunks, how far they lean, where they fork, the crown's outline.

    The picture is a path, an array, a PIL image or an open file. What looks like a photograph is masked first, unless
    ``mask`` is a file that says what is tree; ``box``, ``include``, ``exclude`` and ``strokes`` show the tree in it, as
    in ``pleach.mask``. ``wood`` is a picture of the same size that says what of the tree is trunk and branches. ``tree``
    is the tone that is the tree: ``"auto"``, ``"dark"`` or ``"light"``.

    ``reading`` says what is otherwise in the picture than it is read: a dict with some of the measures, or a
    ``Reading`` whose measures were changed. A value that differs from what was read has the confidence 1; one that is
    repeated has the confidence that stands beside it, or 1. ``trunks`` is short for ``feet`` of which only the number is
    known.

    Raises ``GoalError`` for a picture that has no tree and ``FitError`` for options that cannot be.

    >>> import pleach
    >>> found = pleach.read(pleach.species("acer").grow(7).silhouette(256))
    >>> len(found["feet"]), found["feet_confidence"] > 0.5
    (1, True)
    >>> pleach.read(found.ink, reading={"lean_deg": -8})["lean_deg_confidence"]
    1.0
    """
    pictures: dict[str, Any] = {} if wood is None else {"wood": given(wood)}
    options = {
        "mask": mask,
        "hints": hints(box, include, exclude, strokes),
        "wood": None if wood is None else "wood",
        "reading": corrections(reading),
        "tree": tree,
    }
    measures, ink, annotated = _native.read(given(picture), json.dumps(options), pictures)
    return Reading(measures, ink, annotated)
