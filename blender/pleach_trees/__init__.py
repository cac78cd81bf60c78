# SPDX-License-Identifier: GPL-3.0-or-later
"""Trees from sliders, from species and from pictures: pleach in Blender."""

from __future__ import annotations

from typing import Any

import bpy

from . import files, fit_operators, fitting, map_operators, map_panel, operators, panel, sliders, state, thumbnails, wind_operators

CLASSES = (
    *operators.CLASSES, *fit_operators.CLASSES, *files.CLASSES, *wind_operators.CLASSES, *map_operators.CLASSES,
    *panel.CLASSES, *map_panel.CLASSES,
)


def _menu(menu: Any, _context: Any) -> None:
    menu.layout.operator("pleach.grow", text="Tree of pleach", icon="OUTLINER_OB_CURVES").species = ""


def register() -> None:
    """Called by Blender when the extension is enabled."""
    thumbnails.register()
    state.register()
    sliders.on_change(state.grow_again)
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.VIEW3D_MT_add.append(_menu)
    # Trees of the file that is open; while Blender starts there is none to be looked at yet.
    if hasattr(bpy.data, "objects"):
        state.on_load()


def unregister() -> None:
    """Called by Blender when the extension is disabled; leaves nothing behind."""
    fitting.unregister()
    bpy.types.VIEW3D_MT_add.remove(_menu)
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
    state.unregister()
    thumbnails.unregister()
