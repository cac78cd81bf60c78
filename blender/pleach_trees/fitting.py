"""A fit on a thread of its own. The thread never touches Blender's data: it takes an array and leaves a result."""

from __future__ import annotations

import os
import threading
import time
from typing import Any

import numpy as np

from . import library

WORDS = {"guess": "first guess", "begun": "search", "search": "search", "judging": "judging", "individual": "this very tree",
         "posterior": "how sure it is"}


class Cancelled(Exception):
    """Ends a fit without a result."""


class Job:
    """A running fit, or one that has ended."""

    def __init__(self, picture: Any, **options: Any) -> None:
        self.stage, self.used, self.likeness = "first guess", 0.0, None
        self.fit: Any = None
        self.error = ""
        self.started = time.monotonic()
        self.seconds = float(options.get("timeout") or 0)
        self._cancel, self._stop = threading.Event(), threading.Event()
        # One core is left to Blender.
        options.setdefault("threads", max(1, (os.cpu_count() or 2) - 1))
        self._thread = threading.Thread(target=self._run, args=(picture, options), name="pleach fit", daemon=True)
        self._thread.start()

    def _run(self, picture: Any, options: dict[str, Any]) -> None:
        try:
            self.fit = library.pleach.fit(picture, progress=self._tell, **options)
        except (Cancelled, KeyboardInterrupt):
            self.error = "cancelled"
        except library.pleach.PleachError as error:
            self.error = str(error)
        except Exception as error:  # whatever it is, it has to be seen in the panel
            self.error = f"{type(error).__name__}: {error}"

    def _tell(self, event: dict[str, Any]) -> None:
        if self._cancel.is_set():
            raise Cancelled
        # The library ends with what it has.
        if self._stop.is_set():
            raise KeyboardInterrupt
        self.stage = WORDS.get(event["stage"], event["stage"])
        self.used = min(1.0, float(event.get("used") or 0.0))
        if event.get("likeness") is not None:
            self.likeness = event["likeness"]

    @property
    def running(self) -> bool:
        """Whether it has not ended yet."""
        return self._thread.is_alive()

    @property
    def elapsed(self) -> float:
        """Seconds since it began."""
        return time.monotonic() - self.started

    def cancel(self) -> None:
        """Ends it at its next step, without a result."""
        self._cancel.set()

    def finish(self) -> None:
        """Ends it at its next step, with what it has found."""
        self._stop.set()

    def wait(self, seconds: float | None = None) -> bool:
        """Waits until it has ended; tells whether it has."""
        self._thread.join(seconds)
        return not self.running


_running: list[Job] = []


def start(picture: Any, **options: Any) -> Job:
    """Begins a fit. Raises ``pleach.FitError`` if one is running."""
    if running() is not None:
        raise library.pleach.FitError("a fit is running: wait for it, or cancel it")
    job = Job(picture, **options)
    _running[:] = [job]
    return job


def running() -> Job | None:
    """The fit that is running."""
    return _running[0] if _running and _running[0].running else None


def unregister() -> None:
    """Ends what is running: Blender must not go while a thread of its Python works."""
    for job in _running:
        job.cancel()
        job.wait(30)
    _running.clear()


def pixels(image: Any) -> Any:
    """A picture of Blender's, from a file or packed, as uint8 of (height, width, 4). Raises ``pleach.GoalError``."""
    width, height = image.size
    if not width or not height:
        where = image.filepath or "its file"
        raise library.pleach.GoalError(f"the picture {image.name} cannot be read: {where} is missing, or no picture")
    values = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(values)
    rows = values.reshape(height, width, 4)[::-1]
    if image.is_float:
        # Pictures with more than eight bits a channel are linear.
        colors = np.clip(rows[..., :3], 0, 1)
        encoded = np.where(colors <= 0.0031308, colors * 12.92, 1.055 * np.power(colors, 1 / 2.4) - 0.055)
        rows = np.concatenate([encoded, rows[..., 3:]], axis=2)
    return np.ascontiguousarray(np.round(np.clip(rows, 0, 1) * 255), np.uint8)


def to_image(name: str, picture: Any) -> Any:
    """A picture of uint8 of (height, width, 3) as one of Blender's, packed; one of this name is replaced."""
    import bpy

    height, width = picture.shape[:2]
    image = bpy.data.images.get(name)
    if image is not None and tuple(image.size) != (width, height):
        bpy.data.images.remove(image)
        image = None
    if image is None:
        image = bpy.data.images.new(name, width, height)
    rows = np.ones((height, width, 4), np.float32)
    rows[..., :3] = picture[::-1] / np.float32(255)
    image.pixels.foreach_set(rows.ravel())
    image.update()
    image.pack()
    return image
