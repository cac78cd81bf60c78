"""Silhouettes compared, and photographs masked."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from . import _native
from ._goal import Goal, given


@dataclass(frozen=True)
class Card:
    """How alike two silhouettes are."""

    likeness: float
    """How much the two look like trees of one kind, 0 to 1."""
    iou: float
    """Intersection over union of the ink, 0 to 1. It flatters blobs: see ``best_ellipse_iou``."""
    best_ellipse_iou: float
    """That of the best single ellipse for this goal."""
    boundary_f: float
    """How much of each outline the other passes, 0 to 1."""
    dice: float
    """Twice the intersection over the sum of both, 0 to 1."""
    pixel_accuracy: float
    """The share of equal pixels. It flatters sparse goals: see ``empty_accuracy``."""
    empty_accuracy: float
    """That of an empty picture."""
    chamfer: float
    """The mean distance of the outlines, in heights of the picture; 0 is best."""
    blurred_iou: dict[str, float]
    """IoU after blurring by a part of the height: ``"16"``, ``"32"``, ``"64"``."""
    likeness_parts: dict[str, float]
    """What ``likeness`` is the weighted mean of."""
    crown: dict[str, float]
    """The crown of the first picture, in heights of it."""
    goal_crown: dict[str, float]
    """That of the goal."""

    def _repr_html_(self) -> str:
        rows = [
            ("likeness", self.likeness, ""),
            ("IoU", self.iou, f"best ellipse {self.best_ellipse_iou:.3f}"),
            ("boundary F", self.boundary_f, ""),
            ("pixel accuracy", self.pixel_accuracy, f"empty picture {self.empty_accuracy:.3f}"),
        ]
        cells = "".join(f"<tr><td>{name}</td><td>{value:.3f}</td><td>{note}</td></tr>" for name, value, note in rows)
        return f"<table>{cells}</table>"


def card_of(values: dict[str, Any]) -> Card:
    """The card that the native part has made."""
    return Card(**values)


def score(picture: Goal, goal: Goal) -> Card:
    """How alike two silhouettes of one size are.

    Both are paths, arrays, PIL images or open files. Raises ``GoalError`` if they differ in size or one has no ink.

    >>> import numpy as np, pleach
    >>> ink = np.zeros((64, 64), bool)
    >>> ink[10:60, 20:40] = True
    >>> pleach.score(ink, ink).iou
    1.0
    """
    return card_of(_native.score(given(picture), given(goal)))


@dataclass(frozen=True)
class Mask:
    """The tree in a photograph."""

    ink: npt.NDArray[np.bool_]
    """Bool of shape (height, width), True where the tree is."""
    confidence: float
    """How likely the mask is a good one, 0 to 1; below 0.45 it wants a look."""
    warnings: list[str]
    """What about it is not as a fit expects."""


Point = tuple[int, int]


def hints(
    box: Optional[tuple[int, int, int, int]],
    include: Sequence[Point],
    exclude: Sequence[Point],
    strokes: Optional[str],
) -> dict[str, Any]:
    """What is shown of the tree in a photograph, as the options of a fit have it."""
    return {
        "box": None if box is None else [int(side) for side in box],
        "include": [[int(x), int(y)] for x, y in include],
        "exclude": [[int(x), int(y)] for x, y in exclude],
        "strokes": strokes,
    }


def mask(
    photo: Goal,
    *,
    seed_point: Optional[Point] = None,
    box: Optional[tuple[int, int, int, int]] = None,
    include: Sequence[Point] = (),
    exclude: Sequence[Point] = (),
    strokes: Optional[str] = None,
) -> Mask:
    """Finds the tree in a photograph: a path, uint8 of shape (height, width, 3 or 4), a PIL image or an open file.

    ``box`` is a rectangle around all of the tree: first column, first row, columns and rows. ``include`` and ``exclude``
    are pixels, column and row, of the tree and of something else; ``strokes`` is a file of the photograph's size in
    which what is painted green is tree and what is red is not. ``seed_point`` is a pixel on the tree, where there is
    neither. Raises ``GoalError`` where there is no tree.

    >>> import numpy as np, pleach
    >>> photo = np.full((120, 100, 3), (120, 170, 230), np.uint8)
    >>> photo[30:119, 45:55] = (40, 60, 30)
    >>> pleach.mask(photo).ink.sum()
    np.int64(890)
    """
    ink, about = _native.mask(given(photo), seed_point, json.dumps(hints(box, include, exclude, strokes)))
    return Mask(ink, about["confidence"], about["warnings"])
