"""Procedural trees, their silhouettes, and fits of their parameters to pictures.

    >>> import pleach
    >>> tree = pleach.species("quaking_aspen").grow(7)
    >>> ink = tree.silhouette(64)
    >>> card = pleach.score(ink, pleach.species("quaking_aspen").grow(8).silhouette(64))
    >>> card.likeness > 0.6
    True

The library is the one that the program ``pleach`` is made of: the same goal, options and seed give the same
numbers in both, on any number of threads.
"""

from __future__ import annotations

from ._blend import Map, blend
from ._dataset import Dataset, dataset
from ._fit import Fit, Interval, Posterior, PosteriorNumber, fit
from ._native import (
    FitError,
    GoalError,
    GrowError,
    Mesh,
    MeshPart,
    PleachError,
    Skeleton,
    Species,
    SpeciesError,
    Tree,
    Wind,
    __version__,
    generators,
)
from ._prior import Prior
from ._problem import Numbers, Problem, Scores
from ._reading import Reading, read
from ._score import Card, Mask, mask, score
from ._species import species

__all__ = [
    "Card",
    "Dataset",
    "Fit",
    "FitError",
    "GoalError",
    "GrowError",
    "Interval",
    "Map",
    "Mask",
    "Mesh",
    "MeshPart",
    "Numbers",
    "PleachError",
    "Posterior",
    "PosteriorNumber",
    "Prior",
    "Problem",
    "Reading",
    "Scores",
    "Skeleton",
    "Species",
    "SpeciesError",
    "Tree",
    "Wind",
    "__version__",
    "blend",
    "dataset",
    "fit",
    "generators",
    "mask",
    "read",
    "score",
    "species",
]
