"""Species by name or file."""

from __future__ import annotations

import os
from typing import Union, overload

from . import _native


@overload
def species() -> list[str]: ...
@overload
def species(name: Union[str, "os.PathLike[str]"]) -> _native.Species: ...
def species(name: Union[str, "os.PathLike[str]", None] = None) -> Union[list[str], _native.Species]:
    """The species of this name, or in this file; without one, the names of all built-in species. The file may also be a
    preset of tree-gen or Sapling, a species of Arbaro or a tree of ez-tree, or a measured tree (SWC, or a table of
    cylinders), see ``docs/import.md``.

    Raises ``SpeciesError`` where there is none, and for a file with mistakes, each by line and column.

    >>> import pleach
    >>> "quaking_aspen" in pleach.species()
    True
    >>> pleach.species("quaking_aspen").generator
    'weber-penn'
    """
    if name is None:
        return _native.species_names()
    return _native.species_named(os.fspath(name))
