"""One wind for several trees."""

from __future__ import annotations

from typing import Any

from . import state, wind
from .operators import OfTree


class PLEACH_OT_same_wind(OfTree):
    """Give all selected trees the wind of the active one, or still air if it has none"""

    bl_idname = "pleach.same_wind"
    bl_label = "Same Wind for Selected Trees"

    def run(self, context: Any) -> set[str] | None:
        active = state.tree_of(context)
        others = {tree for tree in map(state.tree_with, context.selected_objects) if tree is not None and tree != active}
        if not others:
            self.report({"WARNING"}, "Select other trees as well: the active one has this wind already")
            return {"CANCELLED"}
        leader, problems = wind.modifier_of(active), []
        for tree in sorted(others, key=lambda tree: tree.name):
            tree.pleach.wind = leader is not None
            problem = state.problems.get(tree.session_uid)
            if problem:
                problems.append(f"{tree.name}: {problem}")
            elif leader is not None:
                wind.copy_settings(leader, wind.modifier_of(tree))
        if problems:
            self.report({"WARNING"}, "; ".join(problems))
        return None


CLASSES = (PLEACH_OT_same_wind,)
