"""The extension in a Blender without a window: installed from its zip, as a user installs it."""

from __future__ import annotations

import os
import pathlib
import subprocess
import sys
import tempfile
from typing import Any

# Before bpy is loaded: nothing of this may reach the settings of the user who runs it.
RESOURCES = tempfile.mkdtemp(prefix="pleach-blender-")
os.environ["BLENDER_USER_RESOURCES"] = RESOURCES

import bpy  # noqa: E402
import addon_utils  # noqa: E402, I001 # bpy brings it
import numpy as np  # noqa: E402

MODULE = "bl_ext.user_default.pleach"
ZIP = os.environ.get("PLEACH_ZIP", "")


def validate() -> str:
    """What Blender's own checker says of the zip."""
    tool = pathlib.Path(addon_utils.__file__).parents[1] / "addons_core/bl_pkg/cli/blender_ext.py"
    done = subprocess.run([sys.executable, str(tool), "validate", ZIP], capture_output=True, text=True)
    if done.returncode:
        raise AssertionError(done.stdout + done.stderr)
    return done.stdout


def install() -> None:
    """Installs the zip and enables it, unless that was done."""
    if MODULE in bpy.context.preferences.addons:
        return
    addon_utils.enable("bl_pkg", default_set=True)
    done = bpy.ops.extensions.package_install_files(filepath=ZIP, repo="user_default", enable_on_install=True)
    assert done == {"FINISHED"}, done
    assert MODULE in bpy.context.preferences.addons, "it is not enabled"


def module(name: str) -> Any:
    """A module of the extension that is installed."""
    return sys.modules[f"{MODULE}.{name}"]


def empty() -> None:
    """A new file without anything in it; the settings stay."""
    bpy.ops.wm.read_homefile(use_empty=True)


def grow(species: str) -> Any:
    """Grows a tree, as a press of the button does."""
    done = bpy.ops.pleach.grow(species=species)
    assert done == {"FINISHED"}, done
    return bpy.context.active_object


def counts(thing: Any) -> dict[str, int]:
    """What the evaluated scene has of a tree: instances of leaves and blossoms, faces of bark and foliage."""
    names = {child.name: child["pleach_part"] for child in thing.children}
    found = {"leaves": 0, "blossom": 0, "foliage": 0, "bark": 0}
    for instance in bpy.context.evaluated_depsgraph_get().object_instances:
        if instance.is_instance and instance.parent.name in names and instance.object.type == "MESH":
            found[names[instance.parent.name]] += 1
        # A curves object whose modifier makes a mesh shows it as an instance of itself.
        elif instance.is_instance and instance.parent.name == thing.name and instance.object.type == "MESH":
            found["bark"] += len(instance.object.data.polygons)
        elif names.get(instance.object.name) in ("foliage", "bark") and not instance.is_instance:
            found[names[instance.object.name]] += len(instance.object.data.polygons)
    return found


def bark_of(thing: Any) -> Any:
    """Corners of the bark of a tree in the evaluated scene, float32 of shape (corners, 3)."""
    for instance in bpy.context.evaluated_depsgraph_get().object_instances:
        if instance.is_instance and instance.parent.name == thing.name and instance.object.type == "MESH":
            mesh = instance.object.data
            corners = np.empty(len(mesh.vertices) * 3, np.float32)
            mesh.vertices.foreach_get("co", corners)
            return corners.reshape(-1, 3)
    return np.empty((0, 3), np.float32)


def attribute(data: Any, name: str, kind: Any = np.float32, width: int = 1) -> Any:
    """An attribute as an array."""
    values = np.empty(len(data.attributes[name].data) * width, kind)
    data.attributes[name].data.foreach_get("vector" if width > 1 else "value", values)
    return values.reshape(-1, width) if width > 1 else values
