"""Training data for machine learning."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Optional, Union

from . import _native
from ._blend import Kind, one_species


@dataclass(frozen=True)
class Dataset:
    """What a data set holds."""

    trees: int
    """Trees of all shards."""
    failures: int
    """Draws that gave no tree; ``failures.csv`` says why."""
    shards: int
    """Files of trees."""
    kept: int
    """Shards that were there already, with ``resume``."""


def dataset(
    kinds: Union[Kind, Sequence[Kind]],
    out: Union[str, "os.PathLike[str]"],
    *,
    count: int = 1000,
    view: Sequence[float] = (0, 90),
    size: int = 96,
    layers: Sequence[str] = (),
    format: str = "npz",
    shard: int = 1000,
    spread: float = 0.15,
    free: Sequence[str] = (),
    fix: Sequence[str] = (),
    seed: int = 1,
    resume: bool = False,
    overwrite: bool = False,
    threads: Optional[int] = None,
    progress: Optional[Callable[[int, int], object]] = None,
) -> Dataset:
    """Writes trees around species, with their numbers and pictures, into the folder ``out``; as ``pleach dataset``, whose
    files it gives byte for byte.

    Species are names or objects, ``count`` trees of each. ``view`` are azimuths in degrees, ``size`` is the side of every
    picture in pixels. ``layers`` says what is saved beside numbers and silhouettes: ``"wood"``, ``"depth"``,
    ``"skeleton"``. ``format`` is ``"npz"``, or ``"webdataset"`` for tar files. A file holds the trees of ``shard`` draws.
    ``spread`` is the standard deviation of each number as a part of its plausible range; ``free`` and ``fix`` are
    patterns of numbers, as in ``pleach.fit``.

    ``resume`` goes on after an interruption, ``overwrite`` replaces the data set in the folder. ``progress`` is a function
    of the draws that are done and of all draws. Ctrl-C raises ``KeyboardInterrupt``; shards that are finished stay.

    Raises ``PleachError`` for options that cannot be, folders with other files, and what cannot be written.

    >>> import pleach, tempfile, pathlib, numpy
    >>> folder = pathlib.Path(tempfile.mkdtemp()) / "palms"
    >>> pleach.dataset("palm", folder, count=4, size=32).trees
    4
    >>> shard = numpy.load(folder / "shard-00000.npz")
    >>> shard["silhouettes"].shape, shard["numbers"].shape[0]
    ((4, 2, 32, 32), 4)
    """
    several = [kinds] if isinstance(kinds, (str, _native.Species)) else list(kinds)
    found = _native.write_dataset(
        [one_species(kind) for kind in several],
        os.fspath(out),
        count,
        [float(azimuth) for azimuth in view],
        size,
        list(layers),
        format,
        shard,
        spread,
        list(free),
        list(fix),
        seed,
        resume,
        overwrite,
        threads,
        progress,
    )
    return Dataset(**found)
