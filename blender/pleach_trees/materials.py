"""Materials of trees: made once, then the user's."""

from __future__ import annotations

from typing import Any

import bpy

COLOR = "pleach color"


def linear(color: tuple[int, int, int]) -> tuple[float, float, float, float]:
    """An sRGB colour of 0 to 255 as Blender's shaders take it."""
    def channel(value: int) -> float:
        part = value / 255
        return part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4

    red, green, blue = color
    return channel(red), channel(green), channel(blue), 1.0


def ensure(material: Any, name: str, kind: str, color: tuple[int, int, int]) -> Any:
    """``material`` in this colour; a new one if it is None.

    One that a user made, or whose colour a user has changed, stays as it is.
    """
    wanted = linear(color)
    if material is None:
        material = _new(name)
        _make(material, kind, wanted)
    node = material.node_tree.nodes.get(COLOR) if material.node_tree else None
    last = material.get("pleach_color")
    if node is None or last is None or not _alike(last, node.outputs[0].default_value):
        return material
    node.outputs[0].default_value = wanted
    material["pleach_color"] = list(wanted)
    material.diffuse_color = wanted
    return material


def _new(name: str) -> Any:
    material = bpy.data.materials.new(name)
    # From Blender 5 on all materials have nodes.
    if bpy.app.version < (5, 0, 0):
        material.use_nodes = True
    return material


def _alike(one: Any, other: Any) -> bool:
    return all(abs(a - b) < 1e-5 for a, b in zip(one, other))


def _make(material: Any, kind: str, color: tuple[float, float, float, float]) -> None:
    tree = material.node_tree
    shader = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    out = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
    source = tree.nodes.new("ShaderNodeRGB")
    source.name = source.label = COLOR
    source.location = (-800, 200)
    source.outputs[0].default_value = color
    material["pleach_color"] = list(color)
    material.diffuse_color = color
    shader.inputs["Roughness"].default_value = 0.9 if kind == "bark" else 0.6
    if "Specular IOR Level" in shader.inputs:
        shader.inputs["Specular IOR Level"].default_value = 0.2
    if kind == "bark":
        tree.links.new(source.outputs[0], shader.inputs["Base Color"])
        return
    # Each leaf is a little darker or lighter than the next one, and light shines through it.
    info = tree.nodes.new("ShaderNodeObjectInfo")
    info.location = (-1000, 0)
    lightness = tree.nodes.new("ShaderNodeMapRange")
    lightness.location = (-800, 0)
    lightness.inputs["To Min"].default_value = 0.75
    lightness.inputs["To Max"].default_value = 1.25
    tree.links.new(info.outputs["Random"], lightness.inputs["Value"])
    varied = tree.nodes.new("ShaderNodeHueSaturation")
    varied.location = (-600, 100)
    tree.links.new(source.outputs[0], varied.inputs["Color"])
    tree.links.new(lightness.outputs[0], varied.inputs["Value"])
    tree.links.new(varied.outputs[0], shader.inputs["Base Color"])
    through = tree.nodes.new("ShaderNodeBsdfTranslucent")
    through.location = (-300, -300)
    tree.links.new(varied.outputs[0], through.inputs["Color"])
    mixed = tree.nodes.new("ShaderNodeMixShader")
    mixed.location = (250, 100)
    mixed.inputs[0].default_value = 0.35 if kind == "leaves" else 0.2
    out.location = (450, 100)
    tree.links.new(shader.outputs[0], mixed.inputs[1])
    tree.links.new(through.outputs[0], mixed.inputs[2])
    tree.links.new(mixed.outputs[0], out.inputs["Surface"])


def picture(name: str, png: bytes, is_color: bool) -> Any:
    """A picture that is packed into the .blend."""
    image = bpy.data.images.new(name, 8, 8)
    image.pack(data=png, data_len=len(png))
    image.source = "FILE"
    image.colorspace_settings.name = "sRGB" if is_color else "Non-Color"
    return image


def with_pictures(name: str, pictures: dict[str, bytes], *, cut_out: bool) -> Any:
    """A new material that shows pictures: ``color``, and where there are any ``normal`` and ``roughness``."""
    material = _new(name)
    tree = material.node_tree
    shader = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Roughness"].default_value = 0.7

    def shows(what: str, y: int) -> Any:
        node = tree.nodes.new("ShaderNodeTexImage")
        node.location = (-700, y)
        node.image = picture(f"{name} {what}", pictures[what], what == "color")
        return node

    color = shows("color", 300)
    tree.links.new(color.outputs["Color"], shader.inputs["Base Color"])
    if cut_out:
        cut = tree.nodes.new("ShaderNodeMath")
        cut.operation = "GREATER_THAN"
        cut.inputs[1].default_value = 0.4
        cut.location = (-400, 150)
        tree.links.new(color.outputs["Alpha"], cut.inputs[0])
        tree.links.new(cut.outputs[0], shader.inputs["Alpha"])
    if "roughness" in pictures:
        parts = tree.nodes.new("ShaderNodeSeparateColor")
        parts.location = (-400, 0)
        tree.links.new(shows("roughness", 0).outputs["Color"], parts.inputs[0])
        tree.links.new(parts.outputs["Green"], shader.inputs["Roughness"])
    if "normal" in pictures:
        bump = tree.nodes.new("ShaderNodeNormalMap")
        bump.location = (-400, -300)
        bump.uv_map = "UVMap"
        tree.links.new(shows("normal", -300).outputs["Color"], bump.inputs["Color"])
        tree.links.new(bump.outputs[0], shader.inputs["Normal"])
    return material
