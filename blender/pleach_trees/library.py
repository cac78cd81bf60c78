"""pleach itself, which comes as a wheel with the extension."""

from __future__ import annotations

from typing import Any

try:
    import pleach
except ImportError as error:  # no wheel for this platform, or one that does not fit its Python
    pleach: Any = None
    MISSING = f"the library pleach does not run here ({error}): install the zip that was built for this platform"
else:
    MISSING = ""

#: Seeds that a slider of Blender's can hold.
MAX_SEED = 2**31 - 1

_species: dict[str, Any] = {}
_families: dict[str, str] = {}


def species_of(text: str) -> Any:
    """The species of the text of a species file. Raises ``pleach.SpeciesError``."""
    found = _species.get(text)
    if found is None:
        found = pleach.Species.from_toml(text, "species")
        # Those of the trees that are being worked on: a text is read once, not for every redraw.
        while len(_species) >= 16:
            _species.pop(next(iter(_species)))
        _species[text] = found
    return found


def family_of(name: str) -> str:
    """The family of a species that is built in: what it grows by."""
    found = _families.get(name)
    if found is None:
        found = _families[name] = pleach.species(name).generator
    return found


def forget() -> None:
    """Drops what is kept."""
    _species.clear()
    _families.clear()
