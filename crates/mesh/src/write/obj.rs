//! Wavefront OBJ with a material file beside it; y up, metres.

use super::decimal::{self, digits};
use super::{one_plain_mesh, total};
use crate::block::{Block, Vertex};
use crate::palette::{Palette, linear};
use crate::part::{Material, MeshError, Part, Sink};
use crate::pictures::Pictures;
use std::io::Write;

/// Writes OBJ text.
#[derive(Debug)]
pub struct Obj<W> {
    out: W,
    name: String,
    material_file: String,
    parts: Vec<Part>,
    firsts: Vec<u32>,
    current: Option<usize>,
    text: Vec<u8>,
}

impl<W: Write> Obj<W> {
    /// Writes to `out`, which should be buffered, an object called `name` that finds its materials in
    /// `material_file` in the same folder; an empty name says that there is no such file.
    pub fn new(out: W, name: &str, material_file: &str) -> Self {
        let one_word = |text: &str| text.split_whitespace().collect::<Vec<_>>().join("_");
        Self {
            out,
            name: one_word(name),
            material_file: material_file.to_owned(),
            parts: Vec::new(),
            firsts: Vec::new(),
            current: None,
            text: Vec::new(),
        }
    }
}

/// The material file that goes with an OBJ file; `pictures` are the names of PNG files in the same
/// folder that materials show instead of their colour.
#[must_use]
pub fn materials(palette: &Palette, pictures: &[Pictures<String>]) -> String {
    let mut text = String::from("# materials of a tree\n");
    for material in Material::ALL {
        let picture = pictures.iter().find(|pictures| pictures.material == material);
        if material == Material::Twig && picture.is_none() {
            continue;
        }
        let [r, g, b] = if picture.is_some() { [1.0; 3] } else { linear(palette.color(material)) };
        text.push_str(&format!(
            "\nnewmtl {}\nKd {r:.4} {g:.4} {b:.4}\nKs 0 0 0\nNs 0\nd 1\nillum 1\n",
            material.name()
        ));
        let Some(pictures) = picture else { continue };
        text.push_str(&format!("map_Kd {}\n", pictures.color));
        if pictures.cutoff.is_some() {
            text.push_str(&format!("map_d {}\n", pictures.color));
        }
        // As programs with materials of physics read them, Blender among them.
        if let Some(name) = &pictures.normal {
            text.push_str(&format!("norm {name}\nmap_Bump {name}\n"));
        }
        if let Some(name) = &pictures.roughness {
            text.push_str(&format!("map_Pr {name}\n"));
        }
    }
    text
}

impl<W: Write> Sink for Obj<W> {
    fn begin(&mut self, parts: &[Part]) -> Result<(), MeshError> {
        one_plain_mesh(parts, "OBJ")?;
        total(parts, |p| p.count.vertices, "corners", "OBJ")?;
        self.parts = parts.to_vec();
        // Corners count from 1.
        let mut first = 1;
        for part in parts {
            self.firsts.push(first);
            first += part.count.vertices as u32;
        }
        writeln!(self.out, "# metres, y up")?;
        if !self.material_file.is_empty() {
            writeln!(self.out, "mtllib {}", self.material_file)?;
        }
        writeln!(self.out, "o {}", self.name)?;
        Ok(())
    }

    fn block(&mut self, part: usize, block: &mut Block) -> Result<(), MeshError> {
        let text = &mut self.text;
        text.clear();
        if self.current.replace(part) != Some(part) {
            let name = self.parts[part].material.name();
            text.extend_from_slice(format!("g {name}\nusemtl {name}\n").as_bytes());
        }
        for &Vertex { position, normal, uv } in &block.vertices {
            line(text, b"v", &[position.x, position.z, -position.y], 5);
            line(text, b"vt", &[uv.x, 1.0 - uv.y], 4);
            line(text, b"vn", &[normal.x, normal.z, -normal.y], 3);
        }
        let first = self.firsts[part];
        for triangle in &block.triangles {
            text.push(b'f');
            for i in triangle.map(|i| u64::from(i + first)) {
                text.push(b' ');
                for slash in [true, true, false] {
                    digits(text, i, 1);
                    if slash {
                        text.push(b'/');
                    }
                }
            }
            text.push(b'\n');
        }
        Ok(self.out.write_all(text)?)
    }

    fn end(&mut self) -> Result<(), MeshError> {
        Ok(self.out.flush()?)
    }
}

/// A keyword and numbers with a given number of decimals.
fn line(text: &mut Vec<u8>, keyword: &[u8], numbers: &[f32], decimals: usize) {
    text.extend_from_slice(keyword);
    for &number in numbers {
        text.push(b' ');
        decimal::push(text, number, decimals);
    }
    text.push(b'\n');
}
