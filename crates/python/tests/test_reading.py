"""What is in a picture, and a tree that is shown in a photograph."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pytest

import pleach


def photograph() -> npt.NDArray[np.uint8]:
    """A brown trunk and a green crown, before a sky above and a hedge of the crown's colour beside."""
    photo = np.full((160, 200, 3), (150, 190, 235), np.uint8)
    rough = (np.arange(160)[:, None] * 7919 + np.arange(200)[None, :] * 104729) % 23
    photo[120:] = (110, 150, 60)
    photo[90:120, :30] = (60, 110, 40)
    photo[90:150, 95:105] = (95, 65, 40)
    rows, columns = np.ogrid[:160, :200]
    crown = (rows - 60) ** 2 + (columns - 100) ** 2 < 40**2
    photo[crown] = (60, 115, 45)
    # Named with its type: some versions of NumPy leave the type of `clip` open.
    noisy: npt.NDArray[np.uint8] = np.clip(photo + rough[..., None] - 11, 0, 255).astype(np.uint8)
    return noisy


def test_a_picture_is_read() -> None:
    ink = pleach.species("acer").grow(3).silhouette(256)
    found = pleach.read(ink)
    assert len(found["feet"]) == 1 and found["leaves"] and found["mask_confidence"] is None
    assert found.annotated.shape == (*found.ink.shape, 3) and found.annotated.dtype == np.uint8
    assert np.array_equal(found.ink, ink)
    assert pleach.read(ink).measures == found.measures


def test_a_box_shows_the_tree() -> None:
    photo = photograph()
    boxed = pleach.mask(photo, box=(50, 10, 100, 145), exclude=[(55, 130)])
    assert boxed.ink[60, 100] and boxed.ink[110, 100] and not boxed.ink[100, 10]
    found = pleach.read(photo, box=(50, 10, 100, 145))
    assert found["mask_confidence"] > 0 and found["colors"]["leaf"].startswith("#")
    with pytest.raises(pleach.GoalError, match="beyond the picture"):
        pleach.mask(photo, box=(150, 10, 100, 145))
    with pytest.raises(pleach.GoalError, match="outside"):
        pleach.mask(photo, include=[(500, 1)])
    with pytest.raises(pleach.FitError, match="hints"):
        pleach.read(photo, box=(50, 10, 0, 145))


def test_a_reading_is_corrected() -> None:
    ink = pleach.species("acer").grow(3).silhouette(256)
    found = pleach.read(ink)
    assert pleach.read(ink, reading=found).measures == found.measures
    said = pleach.read(ink, reading={"trunks": 2, "lean_deg": -8})
    assert len(said["feet"]) == 2 and (said["lean_deg"], said["lean_deg_confidence"]) == (-8, 1)
    found.measures["bare_height"] = 0.3
    fitted = pleach.fit(ink, reading=found, evaluations=4, size=64, individual=False)
    goal = fitted.report["readings"]["goal"]
    assert (goal["bare_height"], goal["bare_height_confidence"]) == (0.3, 1)
    assert fitted.report["options"]["reading"]["bare_height"] == 0.3
    with pytest.raises(pleach.FitError, match="not a measure"):
        pleach.read(ink, reading={"leaning": 3})
