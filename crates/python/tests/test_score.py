"""Goals as users give them, score cards, masks."""

from __future__ import annotations

import io
import pathlib
from typing import Any

import numpy as np
import pytest
from PIL import Image

import pleach

TARGETS = pathlib.Path(__file__).parents[3] / "targets"


def test_a_goal_is_a_path_an_array_a_picture_or_a_file() -> None:
    path = TARGETS / "acer.png"
    picture = Image.open(path)
    gray = np.array(picture.convert("L"))
    ink = gray < 128
    with path.open("rb") as file:
        others: list[Any] = [str(path), picture, gray, np.stack([gray] * 3, axis=2), ink, file]
        for other in others:
            assert pleach.score(other, path).iou == 1.0, type(other)
    # However it lies in memory, and whether or not it may be written.
    turned = np.asfortranarray(ink)
    turned.flags.writeable = False
    assert pleach.score(turned, ink[::-1][::-1]).iou == 1.0


def test_cards_say_what_the_program_says() -> None:
    acer = pleach.species("acer")
    card = pleach.score(acer.grow(1).silhouette(128), acer.grow(2).silhouette(128))
    assert 0 < card.iou < 1 and 0 < card.likeness < 1 and 0 < card.best_ellipse_iou < 1
    assert set(card.blurred_iou) == {"16", "32", "64"} and "<table>" in card._repr_html_()


def test_what_is_no_goal_is_told(tmp_path: pathlib.Path) -> None:
    good = TARGETS / "acer.png"
    closed = io.BytesIO(good.read_bytes())
    closed.close()
    shut = Image.open(good)
    shut.close()
    text = tmp_path / "text.png"
    text.write_text("no picture")
    wrong: list[tuple[object, type[Exception], str]] = [
        (np.zeros((0, 0), bool), pleach.GoalError, "0 × 0"),
        (np.zeros((64, 64)), pleach.GoalError, "float64 of shape"),
        (np.full((64, 64), np.nan), pleach.GoalError, "float64"),
        (np.zeros((64, 64), object), pleach.GoalError, "object"),
        (np.zeros(64, bool), pleach.GoalError, "shape"),
        (np.zeros((64, 64, 2), np.uint8), pleach.GoalError, "shape"),
        (np.zeros((31_623, 31_623), bool), pleach.GoalError, "8192"),
        (np.zeros((31_623, 31_623), np.uint8), pleach.GoalError, "8192"),
        (closed, ValueError, "closed"),
        (shut, Exception, ""),
        (text, pleach.GoalError, "text.png"),
        (tmp_path, pleach.GoalError, ""),
        (tmp_path / "none.png", FileNotFoundError, "none.png"),
        (3, TypeError, "a path, an array"),
        (None, TypeError, "a path, an array"),
    ]
    for goal, error, message in wrong:
        with pytest.raises(error, match=message):
            pleach.score(good, goal)  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    for blank in (np.zeros((64, 64), bool), np.ones((64, 64), bool)):
        with pytest.raises(pleach.GoalError, match="ink|tree"):
            pleach.fit(blank, start="acer", evaluations=1)
    with pytest.raises(pleach.GoalError):
        pleach.score(np.eye(64, dtype=bool), np.eye(65, dtype=bool))


def test_photographs_are_masked() -> None:
    rng = np.random.default_rng(1)
    photo = np.empty((160, 120, 3), np.uint8)
    photo[:] = (120, 170, 230)
    photo = (photo + rng.integers(0, 9, photo.shape)).astype(np.uint8)
    tree = np.zeros((160, 120), bool)
    tree[20:90, 30:90] = True
    tree[90:159, 56:64] = True
    photo[tree] = (40, 60, 30)
    found = pleach.mask(photo)
    assert (found.ink == tree).mean() > 0.99 and 0 <= found.confidence <= 1
    assert np.array_equal(pleach.mask(Image.fromarray(photo), seed_point=(60, 50)).ink, found.ink)
    with pytest.raises(TypeError, match="mask already"):
        pleach.mask(tree)
    with pytest.raises(pleach.GoalError):
        pleach.mask(np.full((64, 64, 3), 200, np.uint8))
