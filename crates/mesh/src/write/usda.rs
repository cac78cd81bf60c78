//! Universal Scene Description as text: an `Xform` with a `Mesh` of bark and a `PointInstancer` or a
//! `Mesh` of leaves and of blossom, with `UsdPreviewSurface` materials; z up, metres.
//!
//! An array of the format is one run of numbers, so a part is kept until it is whole: 32 bytes a
//! corner, 12 a triangle, 40 an instance, which is less than half of the file.

use super::decimal::{self, digits};
use crate::block::Block;
use crate::palette::{Palette, linear};
use crate::part::{Material, MeshError, Part, Sink};
use crate::pictures::Pictures;
use glam::Vec3;
use std::io::Write;

/// Decimals of metres, of unit vectors, and of texture coordinates.
const METERS: usize = 5;
const UNIT: usize = 4;

/// What a file says beside triangles.
#[derive(Clone, Debug, Default)]
pub struct Notes {
    /// Name of the tree; anything but a letter or digit becomes an underscore.
    pub name: String,
    /// Names and values that are kept in the file's head.
    pub about: Vec<(String, String)>,
    /// PNG files beside this one that materials show instead of their colour.
    pub pictures: Vec<Pictures<String>>,
}

/// Writes USDA text.
#[derive(Debug)]
pub struct Usda<'a, W> {
    out: W,
    root: String,
    notes: &'a Notes,
    palette: Palette,
    parts: Vec<Part>,
    current: usize,
    whole: Block,
}

impl<'a, W: Write> Usda<'a, W> {
    /// Writes to `out`, which should be buffered.
    pub fn new(out: W, notes: &'a Notes, palette: Palette) -> Self {
        let root = identifier(&notes.name);
        Self { out, root, notes, palette, parts: Vec::new(), current: 0, whole: Block::default() }
    }

    fn part(&mut self) -> Result<(), MeshError> {
        let Some(part) = self.parts.get(self.current).copied() else { return Ok(()) };
        let block = std::mem::take(&mut self.whole);
        let name = part.material.name();
        if part.instances == 0 {
            return self.mesh(&block, part.material, name, "    ");
        }
        let path = format!("/{}/{name}/shape", self.root);
        let places = &block.instances;
        writeln!(self.out, "\n    def PointInstancer \"{name}\"\n    {{")?;
        write!(self.out, "        rel prototypes = <{path}>")?;
        let out = &mut self.out;
        array(out, "        ", "int[] protoIndices", places, |text, _| text.push(b'0'))?;
        array(out, "        ", "point3f[] positions", places, |text, p| {
            tuple(text, &p.translation.to_array(), METERS);
        })?;
        array(out, "        ", "quath[] orientations", places, |text, p| {
            let [x, y, z, w] = p.rotation.to_array();
            tuple(text, &[w, x, y, z], UNIT);
        })?;
        array(out, "        ", "float3[] scales", places, |text, p| {
            tuple(text, &p.scale.to_array(), METERS);
        })?;
        writeln!(self.out)?;
        self.mesh(&block, part.material, "shape", "        ")?;
        writeln!(self.out, "    }}")?;
        Ok(())
    }

    fn mesh(&mut self, block: &Block, material: Material, name: &str, indent: &str) -> Result<(), MeshError> {
        let (out, inner) = (&mut self.out, format!("{indent}    "));
        write!(
            out,
            "\n{indent}def Mesh \"{name}\" (\n{inner}prepend apiSchemas = [\"MaterialBindingAPI\"]\n{indent})\n{indent}{{"
        )?;
        let corners = format!(" (\n{inner}    interpolation = \"vertex\"\n{inner})");
        let positions = || block.vertices.iter().map(|v| v.position);
        let least = positions().fold(Vec3::INFINITY, Vec3::min);
        let most = positions().fold(Vec3::NEG_INFINITY, Vec3::max);
        let extent = [least.to_array(), most.to_array()];
        array(out, &inner, "float3[] extent", &extent, |text, p| tuple(text, p, METERS))?;
        array(out, &inner, "int[] faceVertexCounts", &block.triangles, |text, _| text.push(b'3'))?;
        array(out, &inner, "int[] faceVertexIndices", block.triangles.as_flattened(), |text, i| {
            digits(text, u64::from(*i), 1);
        })?;
        let vertices = &block.vertices;
        array(out, &inner, "point3f[] points", vertices, |text, v| {
            tuple(text, &v.position.to_array(), METERS);
        })?;
        array(out, &inner, "normal3f[] normals", vertices, |text, v| {
            tuple(text, &v.normal.to_array(), UNIT);
        })?;
        writeln!(out, "{corners}")?;
        // Pictures start at their foot here.
        array(out, &inner, "texCoord2f[] primvars:st", vertices, |text, v| {
            tuple(text, &[v.uv.x, 1.0 - v.uv.y], UNIT);
        })?;
        writeln!(out, "{corners}")?;
        let sides = u8::from(material != Material::Bark);
        writeln!(out, "{inner}uniform token subdivisionScheme = \"none\"")?;
        writeln!(out, "{inner}uniform bool doubleSided = {sides}")?;
        writeln!(out, "{inner}rel material:binding = </{}/materials/{}>", self.root, material.name())?;
        writeln!(out, "{indent}}}")?;
        Ok(())
    }

    /// The textures of a material at `path`, and what places them.
    fn pictures(&mut self, pictures: &Pictures<String>, path: &str) -> Result<(), MeshError> {
        let wrap = if pictures.repeats { "repeat" } else { "clamp" };
        for (what, file) in pictures.all() {
            // Directions are from -1 to 1, and no colours.
            let kind = match what {
                "color" => "token inputs:sourceColorSpace = \"sRGB\"",
                "normal" => {
                    "token inputs:sourceColorSpace = \"raw\"\n                \
                     float4 inputs:scale = (2, 2, 2, 1)\n                \
                     float4 inputs:bias = (-1, -1, -1, 0)"
                }
                _ => "token inputs:sourceColorSpace = \"raw\"",
            };
            write!(
                self.out,
                "\n            def Shader \"{what}\"\n            {{\n                \
                 uniform token info:id = \"UsdUVTexture\"\n                \
                 asset inputs:file = @./{file}@\n                \
                 {kind}\n                \
                 float2 inputs:st.connect = <{path}/place.outputs:result>\n                \
                 token inputs:wrapS = \"{wrap}\"\n                \
                 token inputs:wrapT = \"{wrap}\"\n                \
                 float outputs:r\n                \
                 float outputs:g\n                \
                 float outputs:a\n                \
                 float3 outputs:rgb\n            }}\n"
            )?;
        }
        write!(
            self.out,
            "\n            def Shader \"place\"\n            {{\n                \
             uniform token info:id = \"UsdPrimvarReader_float2\"\n                \
             string inputs:varname = \"st\"\n                \
             float2 outputs:result\n            }}\n"
        )?;
        Ok(())
    }

    fn materials(&mut self) -> Result<(), MeshError> {
        writeln!(self.out, "\n    def Scope \"materials\"\n    {{")?;
        let mut used: Vec<Material> = self.parts.iter().map(|p| p.material).collect();
        used.dedup();
        for material in used {
            let picture = self.notes.pictures.iter().find(|pictures| pictures.material == material);
            let path = format!("/{}/materials/{}", self.root, material.name());
            let [r, g, b] = linear(self.palette.color(material));
            let mut inputs = match picture {
                Some(_) => vec![format!("color3f inputs:diffuseColor.connect = <{path}/color.outputs:rgb>")],
                None => vec![format!("color3f inputs:diffuseColor = ({r:.4}, {g:.4}, {b:.4})")],
            };
            if let Some(cutoff) = picture.and_then(|pictures| pictures.cutoff) {
                inputs.push(format!("float inputs:opacity.connect = <{path}/color.outputs:a>"));
                inputs.push(format!("float inputs:opacityThreshold = {cutoff:.2}"));
            }
            if picture.is_some_and(|pictures| pictures.normal.is_some()) {
                inputs.push(format!("normal3f inputs:normal.connect = <{path}/normal.outputs:rgb>"));
            }
            if picture.is_some_and(|pictures| pictures.roughness.is_some()) {
                inputs.push(format!("float inputs:occlusion.connect = <{path}/roughness.outputs:r>"));
                inputs.push(format!("float inputs:roughness.connect = <{path}/roughness.outputs:g>"));
            } else {
                let roughness = if material == Material::Bark { 0.95 } else { 0.7 };
                inputs.push(format!("float inputs:roughness = {roughness}"));
            }
            let inputs = inputs.join("\n                ");
            write!(
                self.out,
                "        def Material \"{}\"\n        {{\n            \
                 token outputs:surface.connect = <{path}/surface.outputs:surface>\n\n            \
                 def Shader \"surface\"\n            {{\n                \
                 uniform token info:id = \"UsdPreviewSurface\"\n                \
                 {inputs}\n                \
                 token outputs:surface\n            }}\n",
                material.name()
            )?;
            if let Some(pictures) = picture {
                self.pictures(pictures, &path)?;
            }
            writeln!(self.out, "        }}")?;
        }
        writeln!(self.out, "    }}")?;
        Ok(())
    }
}

impl<W: Write> Sink for Usda<'_, W> {
    fn begin(&mut self, parts: &[Part]) -> Result<(), MeshError> {
        let unsupported = |what| Err(MeshError::Unsupported { what, format: "USDA" });
        if parts.iter().any(|p| p.mesh != 0) {
            return unsupported("several levels of detail or variants");
        }
        if parts.iter().any(|p| p.rigged) {
            return unsupported("joints");
        }
        self.parts = parts.to_vec();
        writeln!(self.out, "#usda 1.0\n(\n    customLayerData = {{")?;
        for (name, value) in &self.notes.about {
            let quoted = value.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', " ");
            writeln!(self.out, "        string {} = \"{quoted}\"", identifier(name))?;
        }
        write!(
            self.out,
            "    }}\n    defaultPrim = \"{root}\"\n    metersPerUnit = 1\n    upAxis = \"Z\"\n)\n\n\
             def Xform \"{root}\" (\n    kind = \"component\"\n)\n{{",
            root = self.root
        )?;
        Ok(())
    }

    fn block(&mut self, part: usize, block: &mut Block) -> Result<(), MeshError> {
        if part != self.current {
            self.part()?;
            self.current = part;
        }
        self.whole.vertices.append(&mut block.vertices);
        self.whole.triangles.append(&mut block.triangles);
        self.whole.instances.append(&mut block.instances);
        Ok(())
    }

    fn end(&mut self) -> Result<(), MeshError> {
        self.part()?;
        self.materials()?;
        writeln!(self.out, "}}")?;
        Ok(self.out.flush()?)
    }
}

/// A name as the format wants it.
fn identifier(name: &str) -> String {
    let mut text: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if !text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') {
        text.insert(0, '_');
    }
    text
}

fn tuple(text: &mut Vec<u8>, numbers: &[f32], decimals: usize) {
    text.push(b'(');
    for (i, &number) in numbers.iter().enumerate() {
        if i > 0 {
            text.extend_from_slice(b", ");
        }
        decimal::push(text, number, decimals);
    }
    text.push(b')');
}

/// An array on a line of its own, whose end is left to the caller; written a few kilobytes at a time.
fn array<T>(
    out: &mut impl Write,
    indent: &str,
    name: &str,
    items: &[T],
    push: impl Fn(&mut Vec<u8>, &T),
) -> Result<(), MeshError> {
    write!(out, "\n{indent}{name} = [")?;
    let mut text = Vec::new();
    for (i, item) in items.iter().enumerate() {
        if i > 0 {
            text.extend_from_slice(b", ");
        }
        push(&mut text, item);
        if text.len() > 1 << 14 {
            out.write_all(&text)?;
            text.clear();
        }
    }
    text.push(b']');
    Ok(out.write_all(&text)?)
}
