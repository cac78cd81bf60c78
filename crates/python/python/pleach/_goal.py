"""What a goal may be."""

from __future__ import annotations

import io
import os
from typing import Any, Protocol, Union, runtime_checkable

import numpy as np
import numpy.typing as npt


class Readable(Protocol):
    """An open file, or anything else that gives the bytes of a picture."""

    def read(self) -> bytes: ...


@runtime_checkable
class Image(Protocol):
    """A picture of PIL."""

    @property
    def mode(self) -> str: ...

    def save(self, fp: Any, format: str) -> None: ...


#: A path; an array of bool, shape (height, width), True where the tree is; an array of uint8, shape (height,
#: width), (height, width, 3) or (height, width, 4); a PIL image; an open file.
Goal = Union[str, "os.PathLike[str]", npt.NDArray[np.bool_], npt.NDArray[np.uint8], Image, Readable]


def given(goal: Goal) -> Any:
    """What the native part takes: a path, an array, or the bytes of a file."""
    if isinstance(goal, np.ndarray):
        return goal
    if isinstance(goal, (str, os.PathLike)):
        return os.fspath(goal)
    if isinstance(goal, Image):
        file = io.BytesIO()
        goal.save(file, format="PNG")
        return file.getvalue()
    read = getattr(goal, "read", None)
    # What is nothing of all this the native part refuses, and says what it may be.
    return read() if callable(read) else goal
