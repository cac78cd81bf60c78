"""Node groups: bark around curves, and leaves on points.

A group is made once for a file and never changed afterwards, so that a user may edit it.
"""

from __future__ import annotations

from typing import Any, Callable

import bpy

BARK = "pleach bark 1"
LEAVES = "pleach leaves 1"


class Builder:
    """Makes the nodes of a group."""

    def __init__(self, name: str) -> None:
        self.group: Any = bpy.data.node_groups.new(name, "GeometryNodeTree")
        self.group.is_modifier = True
        self.column = 0

    def socket(self, name: str, kind: str, out: bool = False, **settings: Any) -> None:
        """Adds an input of the group, or its output."""
        in_out = "OUTPUT" if out else "INPUT"
        socket = self.group.interface.new_socket(name, in_out=in_out, socket_type=kind)
        for key, value in settings.items():
            setattr(socket, key, value)

    def node(self, kind: str, inputs: dict[Any, Any] | None = None, **settings: Any) -> Any:
        """Adds a node; inputs are values, or the outputs of other nodes."""
        node = self.group.nodes.new(kind)
        self.column += 1
        node.location = (180 * (self.column // 4), -220 * (self.column % 4))
        for key, value in settings.items():
            setattr(node, key, value)
        for key, value in (inputs or {}).items():
            socket = node.inputs[key]
            if isinstance(value, bpy.types.NodeSocket):
                self.group.links.new(value, socket)
            else:
                socket.default_value = value
        return node

    def math(self, operation: str, *values: Any) -> Any:
        """A number that is computed from others."""
        return self.node("ShaderNodeMath", dict(enumerate(values)), operation=operation).outputs[0]

    def compare(self, operation: str, a: Any, b: int) -> Any:
        """Whether a whole number compares so with another."""
        node = self.node("FunctionNodeCompare", data_type="INT", operation=operation)
        whole = [socket for socket in node.inputs if socket.type == "INT"]
        self.group.links.new(a, whole[0])
        whole[1].default_value = b
        return node.outputs[0]

    def attribute(self, name: str, kind: str) -> Any:
        """An attribute by name."""
        node = self.node("GeometryNodeInputNamedAttribute", {"Name": name}, data_type=kind)
        return next(socket for socket in node.outputs if socket.enabled)

    def switch(self, kind: str, which: Any, no: Any, yes: Any) -> Any:
        """One of two values; of geometries, only one is computed."""
        inputs = {"Switch": which}
        inputs.update({name: value for name, value in (("False", no), ("True", yes)) if value is not None})
        return self.node("GeometryNodeSwitch", inputs, input_type=kind).outputs[0]


def group(name: str, make: Callable[[Builder], None]) -> Any:
    """The group of this name; it is made where the file has none."""
    found = bpy.data.node_groups.get(name)
    if found is not None:
        return found
    builder = Builder(name)
    make(builder)
    return builder.group


def bark() -> Any:
    """The group that puts bark around curves."""
    return group(BARK, _make_bark)


def leaves() -> Any:
    """The group that puts leaves on points."""
    return group(LEAVES, _make_leaves)


#: Of levels 0, 1 and those above: the part of the sides that a stem has.
SIDES = (1, 2, 4)


def _make_bark(b: Builder) -> None:
    b.socket("Geometry", "NodeSocketGeometry")
    b.socket("Show", "NodeSocketBool", default_value=True, description="Whether bark is made from the curves")
    b.socket("Sides", "NodeSocketInt", default_value=12, min_value=3, max_value=96,
             description="Sides of trunks; branches have half as many, twigs a quarter")
    b.socket("Resolution", "NodeSocketInt", default_value=3, min_value=1, max_value=32,
             description="Pieces of a trunk between two knots; branches have fewer")
    b.socket("UV Map", "NodeSocketBool", default_value=True, description="Whether bark has texture coordinates")
    b.socket("Material", "NodeSocketMaterial")
    b.socket("Geometry", "NodeSocketGeometry", out=True)
    given = b.node("NodeGroupInput").outputs
    level = b.attribute("level", "INT")
    curves = b.node("GeometryNodeSetSplineResolution", {
        "Geometry": given["Geometry"],
        "Resolution": b.math("MAXIMUM", b.math("SUBTRACT", given["Resolution"], level), 1),
    }).outputs[0]
    length = b.node("GeometryNodeSplineParameter").outputs["Length"]
    curves = b.node("GeometryNodeStoreNamedAttribute",
                    {"Geometry": curves, "Name": "along", "Value": length}, data_type="FLOAT", domain="POINT").outputs[0]
    made = []
    for number, part in enumerate(SIDES):
        which = b.compare("EQUAL" if number < 2 else "GREATER_EQUAL", level, number)
        some = b.node("GeometryNodeSeparateGeometry", {"Geometry": curves, "Selection": which}, domain="CURVE").outputs[0]
        sides = b.math("MAXIMUM", b.math("FLOOR", b.math("DIVIDE", given["Sides"], part)), 3)
        made.append(_tube(b, some, sides))
    joined = b.node("GeometryNodeJoinGeometry").inputs[0]
    for tube in reversed(made):
        b.group.links.new(tube, joined)
    mesh = joined.node.outputs[0]
    with_uv = _bark_uv(b, mesh)
    mesh = b.switch("GEOMETRY", given["UV Map"], mesh, with_uv)
    mesh = b.node("GeometryNodeSetShadeSmooth", {"Geometry": mesh}).outputs[0]
    mesh = b.node("GeometryNodeSetMaterial", {"Geometry": mesh, "Material": given["Material"]}).outputs[0]
    shown = b.switch("GEOMETRY", given["Show"], None, mesh)
    b.node("NodeGroupOutput", {"Geometry": shown})


def _tube(b: Builder, curves: Any, sides: Any) -> Any:
    circle = b.node("GeometryNodeCurvePrimitiveCircle", {"Resolution": sides, "Radius": 1.0}).outputs[0]
    around = b.node("GeometryNodeSplineParameter").outputs["Factor"]
    circle = b.node("GeometryNodeStoreNamedAttribute",
                    {"Geometry": circle, "Name": "around", "Value": around}, data_type="FLOAT", domain="POINT").outputs[0]
    tube = b.node("GeometryNodeCurveToMesh", {"Curve": curves, "Profile Curve": circle})
    # Blender 5 does not scale the profile by the radius on its own.
    if "Scale" in tube.inputs:
        b.group.links.new(b.node("GeometryNodeInputRadius").outputs[0], tube.inputs["Scale"])
    return tube.outputs[0]


def _bark_uv(b: Builder, mesh: Any) -> Any:
    """Tiles of half a metre, by the radius at the foot of each stem; a tile is as high as it is wide there."""
    around = b.attribute("around", "FLOAT")
    middle = b.node("GeometryNodeFieldOnDomain", {0: around}, domain="FACE", data_type="FLOAT").outputs[0]
    # The last face of a ring runs from its last corner to 1, not back to 0.
    last = b.math("GREATER_THAN", b.math("SUBTRACT", middle, around), 0.25)
    girth = b.math("MULTIPLY", b.math("MAXIMUM", b.attribute("base_radius", "FLOAT"), 1e-4), 6.2831853)
    tiles = b.math("MAXIMUM", b.math("ROUND", b.math("DIVIDE", girth, 0.5)), 1.0)
    u = b.math("MULTIPLY", b.math("ADD", around, last), tiles)
    v = b.math("DIVIDE", b.math("MULTIPLY", b.attribute("along", "FLOAT"), tiles), girth)
    uv = b.node("ShaderNodeCombineXYZ", {"X": u, "Y": v}).outputs[0]
    return b.node("GeometryNodeStoreNamedAttribute", {"Geometry": mesh, "Name": "UVMap", "Value": uv},
                  data_type="FLOAT2", domain="CORNER").outputs[0]


def _make_leaves(b: Builder) -> None:
    b.socket("Geometry", "NodeSocketGeometry")
    b.socket("Shapes", "NodeSocketCollection", description="Objects that stand for leaves, in the order of their names")
    b.socket("Viewport Share", "NodeSocketFloat", default_value=1.0, min_value=0.0, max_value=1.0, subtype="FACTOR",
             description="Part of the leaves that the viewport shows; renders show all")
    b.socket("Geometry", "NodeSocketGeometry", out=True)
    given = b.node("NodeGroupInput").outputs
    viewport = b.node("GeometryNodeIsViewport").outputs[0]
    share = b.switch("FLOAT", viewport, 1.0, given["Viewport Share"])
    index = b.node("GeometryNodeInputIndex").outputs[0]
    # The fractional part of multiples of the golden ratio: any share of them is spread evenly over the tree.
    drawn = b.math("FRACT", b.math("MULTIPLY", index, 0.6180339887))
    shown = b.math("LESS_THAN", drawn, share)
    across, along = b.attribute("across", "FLOAT_VECTOR"), b.attribute("along", "FLOAT_VECTOR")
    turn = b.node("FunctionNodeAxesToRotation", {"Primary Axis": across, "Secondary Axis": along},
                  primary_axis="X", secondary_axis="Y").outputs[0]
    lengths = [b.node("ShaderNodeVectorMath", {0: axis}, operation="LENGTH").outputs["Value"] for axis in (across, along)]
    scale = b.node("ShaderNodeCombineXYZ", {"X": lengths[0], "Y": lengths[1], "Z": lengths[1]}).outputs[0]
    shapes = b.node("GeometryNodeCollectionInfo", {"Collection": given["Shapes"], "Separate Children": True,
                                                   "Reset Children": True}).outputs[0]
    placed = b.node("GeometryNodeInstanceOnPoints", {
        "Points": given["Geometry"], "Selection": shown, "Instance": shapes, "Pick Instance": True,
        "Instance Index": b.attribute("shape", "INT"), "Rotation": turn, "Scale": scale,
    }).outputs[0]
    b.node("NodeGroupOutput", {"Geometry": placed})


def key_of(modifier: Any, name: str) -> str | None:
    """The key under which a modifier keeps an input of its group; `None` where the user's group has no such input."""
    for item in modifier.node_group.interface.items_tree if modifier.node_group else ():
        if item.item_type == "SOCKET" and item.in_out == "INPUT" and item.name == name:
            return str(item.identifier)
    return None


def set_input(modifier: Any, name: str, value: Any) -> None:
    """Sets an input of the group of a modifier by its name. The only place that knows how a modifier keeps them."""
    key = key_of(modifier, name)
    if key is not None:
        modifier[key] = value
        modifier.id_data.update_tag()


def get_input(modifier: Any, name: str) -> Any:
    """The value of an input of the group of a modifier, or None if the user's group has no such input."""
    key = key_of(modifier, name)
    return None if key is None else modifier.get(key)


def modifier_of(thing: Any, name: str, make: Callable[[], Any]) -> Any:
    """The modifier of this name; it is added where the object has none. A user may have given it another group."""
    modifier = thing.modifiers.get(name)
    if modifier is None:
        modifier = thing.modifiers.new(name, "NODES")
    if modifier.node_group is None:
        modifier.node_group = make()
    return modifier
