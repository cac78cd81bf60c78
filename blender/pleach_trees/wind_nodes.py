"""The node groups of wind: the formula of pleach's docs/wind.md, for curves, for meshes and for the points of leaves."""

from __future__ import annotations

import math
from typing import Any

from .nodes import Builder, group

STEMS, MESHES, LEAVES, TURN = "pleach wind 1", "pleach wind on meshes 1", "pleach wind on leaves 1", "pleach wind turn 1"

#: No body turns by more than this, in radians.
MAX_TURN = 0.25
#: How far the top of a tree leans in a fresh breeze, over its height.
LEAN = 0.03
#: How far a piece of a curve may stray from where the formula takes all of its points, in metres.
STRAY = 0.0008
#: Metres per second at which gusts go from tree to tree.
SPEED = 8.0


def stems() -> Any:
    """The group that moves curves."""
    return group(STEMS, _make_stems)


def meshes() -> Any:
    """The group that moves bark, foliage and baked levels."""
    return group(MESHES, _make_meshes)


def leaves() -> Any:
    """The group that moves points of leaves, and turns what stands on them."""
    return group(LEAVES, _make_leaves)


def _vector(b: Builder, operation: str, *values: Any) -> Any:
    """A vector that is computed from vectors; a number for lengths and dot products. `SCALE` takes a vector and a number."""
    inputs: dict[Any, Any] = dict(enumerate(values))
    if operation == "SCALE":
        inputs = {0: values[0], "Scale": values[1]}
    node = b.node("ShaderNodeVectorMath", inputs, operation=operation)
    return node.outputs["Value" if operation in ("LENGTH", "DOT_PRODUCT") else "Vector"]


def _upwards(b: Builder, z: Any) -> Any:
    return b.node("ShaderNodeCombineXYZ", {"Z": z}).outputs[0]


def _sin_turns(b: Builder, turns: Any, times: float = 1.0, plus: float = 0.0) -> Any:
    """The sine of `times * turns + plus` turns."""
    return b.math("SINE", b.math("MULTIPLY_ADD", turns, math.tau * times, math.tau * plus))


def _make_turn(b: Builder) -> None:
    """How a body turns about its base: the axis, as long as the radians for each metre from the base."""
    b.group.is_modifier = False
    for name, kind in (("Bend", "Vector"), ("Phase", "Float"), ("Wind", "Vector"), ("Time", "Float")):
        b.socket(name, f"NodeSocket{kind}")
    b.socket("Turn", "NodeSocketVector", out=True)
    given = b.node("NodeGroupInput").outputs
    # Small bodies are quick.
    pace = b.math("MULTIPLY_ADD", b.math("SQRT", _vector(b, "LENGTH", given["Bend"])), 1.5, 0.25)
    turns = b.math("MULTIPLY_ADD", pace, given["Time"], given["Phase"])
    gust = b.math("MULTIPLY_ADD", _sin_turns(b, turns), 0.6, 0.4)
    strength = b.math("MULTIPLY", _vector(b, "LENGTH", given["Wind"]), 0.25)
    bob = b.math("MULTIPLY", _sin_turns(b, turns, 1.37, 0.3), strength)
    force = _vector(b, "ADD", _vector(b, "SCALE", given["Wind"], gust), _upwards(b, bob))
    b.node("NodeGroupOutput", {"Turn": _vector(b, "CROSS_PRODUCT", given["Bend"], force)})


class _Formula:
    """A group that moves something: the wind, and how what is to move turns in it."""

    def __init__(self, b: Builder) -> None:
        self.b = b
        b.socket("Geometry", "NodeSocketGeometry")
        b.socket("Strength", "NodeSocketFloat", default_value=1.0, min_value=0.0, max_value=3.0,
                 description="0 for still air, 1 for a fresh breeze")
        b.socket("Direction", "NodeSocketFloat", subtype="ANGLE", default_value=0.0,
                 description="Where the wind blows to, in the scene: 0 for x, 90° for y")
        b.socket("Height", "NodeSocketFloat", subtype="DISTANCE", default_value=10.0, min_value=0.001,
                 description="How high the tree is: of two trees the lower one leans further at the same height")
        b.socket("Geometry", "NodeSocketGeometry", out=True)
        self.given = given = b.node("NodeGroupInput").outputs
        side = b.math("COSINE", given["Direction"]), b.math("SINE", given["Direction"])
        across = b.node("ShaderNodeCombineXYZ", {"X": side[0], "Y": side[1]}).outputs[0]
        # The wind is that of the scene, however the tree is turned.
        own = b.node("GeometryNodeObjectInfo", {"Object": b.node("GeometryNodeSelfObject").outputs[0]}).outputs
        back = b.node("FunctionNodeInvertRotation", {0: own["Rotation"]}).outputs[0]
        turned = b.node("FunctionNodeRotateVector", {"Vector": across, "Rotation": back}).outputs[0]
        self.wind = _vector(b, "SCALE", turned, given["Strength"])
        # Gusts come later to trees that stand further on.
        late = b.math("DIVIDE", _vector(b, "DOT_PRODUCT", own["Location"], across), SPEED)
        self.time = b.math("SUBTRACT", b.node("GeometryNodeInputSceneTime").outputs["Seconds"], late)
        #: Of the body itself and of the one that carries it.
        self.bends, self.phases, self.pivots = (
            [b.attribute(f"wind_{whose}{name}", kind) for whose in ("", "parent_")]
            for name, kind in (("bend", "FLOAT_VECTOR"), ("phase", "FLOAT"), ("pivot", "FLOAT_VECTOR"))
        )

    def turns(self) -> list[Any]:
        """How both bodies turn."""
        found = []
        for bend, phase in zip(self.bends, self.phases):
            node = self.b.node("GeometryNodeGroup", node_tree=group(TURN, _make_turn))
            for name, value in (("Bend", bend), ("Phase", phase), ("Wind", self.wind), ("Time", self.time)):
                self.b.group.links.new(value, node.inputs[name])
            found.append(node.outputs["Turn"])
        return found

    def moved(self, position: Any, turns: list[Any]) -> tuple[Any, list[Any]]:
        """Where a position goes, and the rotations that take it there but for the lean of the whole tree."""
        b, rotations = self.b, []
        for pivot, turn in zip(self.pivots, turns):
            arm = _vector(b, "SUBTRACT", position, pivot)
            # The more the further from the base, but never by a right angle.
            angle = b.math("MULTIPLY", _vector(b, "LENGTH", turn), _vector(b, "LENGTH", arm))
            angle = b.math("DIVIDE", angle, b.math("MULTIPLY_ADD", angle, 1.0 / MAX_TURN, 1.0))
            rotation = b.node("FunctionNodeAxisAngleToRotation", {"Axis": turn, "Angle": angle}).outputs[0]
            rotations.append(rotation)
            position = _vector(b, "ADD", self.rotated(arm, rotation), pivot)
        return self._leaned(position), rotations

    def rotated(self, vector: Any, rotation: Any) -> Any:
        """A direction after a rotation."""
        return self.b.node("FunctionNodeRotateVector", {"Vector": vector, "Rotation": rotation}).outputs[0]

    def _leaned(self, position: Any) -> Any:
        """The whole tree, by the height above the ground."""
        b = self.b
        up = b.math("MAXIMUM", b.node("ShaderNodeSeparateXYZ", {0: position}).outputs["Z"], 0.0)
        gust = b.math("MULTIPLY_ADD", _sin_turns(b, self.time, 0.21), 0.5 * LEAN, 0.5 * LEAN)
        bow = _vector(b, "SCALE", self.wind, b.math("DIVIDE", gust, b.math("MAXIMUM", self.given["Height"], 0.001)))
        fall = b.math("MULTIPLY", _vector(b, "DOT_PRODUCT", bow, bow), -2.0 / 3.0)
        square = b.math("MULTIPLY", up, up)
        across = _vector(b, "ADD", position, _vector(b, "SCALE", bow, square))
        return _vector(b, "ADD", across, _upwards(b, b.math("MULTIPLY", fall, b.math("MULTIPLY", square, up))))

    def fluttered(self, vector: Any, normal: Any) -> Any:
        """A vector that goes along a normal with the beat of the leaf."""
        b, position = self.b, self.position()
        turns = b.math("MULTIPLY_ADD", self.time, 3.0, self.phases[0])
        turns = b.math("ADD", turns, _vector(b, "DOT_PRODUCT", position, (1.3, 1.7, 0.9)))
        far = b.math("MULTIPLY", b.attribute("wind_flutter", "FLOAT"), _vector(b, "LENGTH", self.wind))
        return _vector(b, "ADD", vector, _vector(b, "SCALE", normal, b.math("MULTIPLY", far, _sin_turns(b, turns))))

    def position(self) -> Any:
        """The position of each point."""
        return self.b.node("GeometryNodeInputPosition").outputs[0]

    def kept(self, geometry: Any, value: Any, kind: str = "VECTOR", domain: str = "POINT") -> tuple[Any, Any]:
        """A geometry that remembers a value as it is now, and that value."""
        node = self.b.node("GeometryNodeCaptureAttribute", {"Geometry": geometry}, domain=domain)
        item = node.capture_items.new(kind, "Value")
        self.b.group.links.new(value, node.inputs[item.name])
        return node.outputs["Geometry"], node.outputs[item.name]


def _cut(formula: _Formula, geometry: Any) -> Any:
    """Curves with more points where they bend: only points move by the formula, and what is between two of them follows those."""
    b = formula.b
    following = b.node("GeometryNodeOffsetPointInCurve", {"Offset": 1}).outputs
    position = formula.position()
    at = b.node("GeometryNodeFieldAtIndex", {"Index": following["Point Index"], "Value": position}, data_type="FLOAT_VECTOR",
                domain="POINT").outputs[0]
    length = _vector(b, "LENGTH", _vector(b, "SUBTRACT", at, position))
    length = b.switch("FLOAT", following["Is Valid Offset"], 0.0, length)
    bends = [_vector(b, "LENGTH", bend) for bend in formula.bends]
    lean = b.math("DIVIDE", LEAN, b.math("MAXIMUM", formula.given["Height"], 0.001))
    bend = b.math("MULTIPLY", b.math("ADD", b.math("ADD", *bends), lean), _vector(b, "LENGTH", formula.wind))
    # The middle of a piece, which turns by its distance from the pivot, leaves the straight line between the ends.
    astray = b.math("MULTIPLY", b.math("MULTIPLY", length, length), b.math("MULTIPLY", bend, 0.25 / STRAY))
    cuts = b.math("MINIMUM", b.math("FLOOR", b.math("SQRT", astray)), 15.0)
    return b.node("GeometryNodeSubdivideCurve", {"Curve": geometry, "Cuts": cuts}).outputs[0]


def _make_stems(b: Builder) -> None:
    formula = _Formula(b)
    geometry = _cut(formula, formula.given["Geometry"])
    turns = []
    for turn in formula.turns():
        geometry, kept = formula.kept(geometry, turn, domain="CURVE")
        turns.append(kept)
    handles = b.node("GeometryNodeInputCurveHandlePositions").outputs
    places = []
    # Both are computed before points move, which take handles along.
    for side in ("Left", "Right"):
        geometry, kept = formula.kept(geometry, formula.moved(handles[side], turns)[0])
        places.append((side, kept))
    place, _ = formula.moved(formula.position(), turns)
    geometry = b.node("GeometryNodeSetPosition", {"Geometry": geometry, "Position": place}).outputs[0]
    for side, kept in places:
        geometry = b.node("GeometryNodeSetCurveHandlePositions", {"Curve": geometry, "Position": kept}, mode=side.upper()).outputs[0]
    b.node("NodeGroupOutput", {"Geometry": geometry})


def _make_meshes(b: Builder) -> None:
    formula = _Formula(b)
    normal = b.node("GeometryNodeInputNormal").outputs["Normal"]
    place, _ = formula.moved(formula.fluttered(formula.position(), normal), formula.turns())
    geometry = b.node("GeometryNodeSetPosition", {"Geometry": formula.given["Geometry"], "Position": place}).outputs[0]
    b.node("NodeGroupOutput", {"Geometry": geometry})


def _make_leaves(b: Builder) -> None:
    formula = _Formula(b)
    across, along = b.attribute("across", "FLOAT_VECTOR"), b.attribute("along", "FLOAT_VECTOR")
    # The tip goes along the normal of the blade, and the stalk stays.
    normal = _vector(b, "NORMALIZE", _vector(b, "CROSS_PRODUCT", across, along))
    place, (first, second) = formula.moved(formula.position(), formula.turns())
    both = b.node("FunctionNodeRotateRotation", {"Rotation": first, "Rotate By": second}, rotation_space="GLOBAL").outputs[0]
    geometry = formula.given["Geometry"]
    # All of them are computed before the point moves.
    geometry, rotation = formula.kept(geometry, both, kind="ROTATION")
    geometry, tip = formula.kept(geometry, formula.fluttered(along, normal))
    geometry = b.node("GeometryNodeSetPosition", {"Geometry": geometry, "Position": place}).outputs[0]
    for name, vector in (("across", across), ("along", tip)):
        geometry = b.node("GeometryNodeStoreNamedAttribute",
                          {"Geometry": geometry, "Name": name, "Value": formula.rotated(vector, rotation)},
                          data_type="FLOAT_VECTOR", domain="POINT").outputs[0]
    b.node("NodeGroupOutput", {"Geometry": geometry})
