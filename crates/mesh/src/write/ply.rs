//! Binary little-endian PLY: corners with normal, texture coordinates, colour and (if asked for)
//! wind or growth, then triangles; z up, metres.
//!
//! The format wants all corners before the first triangle, so the triangles of earlier parts are kept
//! until the end: 12 bytes each.

use super::{one_plain_mesh, total};
use crate::block::Block;
use crate::palette::Palette;
use crate::part::{MeshError, Part, Sink};
use std::io::Write;

/// Writes PLY.
#[derive(Debug)]
pub struct Ply<W> {
    out: W,
    palette: Palette,
    parts: Vec<Part>,
    /// Corners of earlier parts.
    firsts: Vec<u32>,
    faces: Vec<u8>,
    bytes: Vec<u8>,
}

impl<W: Write> Ply<W> {
    /// Writes to `out`, which should be buffered.
    pub const fn new(out: W, palette: Palette) -> Self {
        Self { out, palette, parts: Vec::new(), firsts: Vec::new(), faces: Vec::new(), bytes: Vec::new() }
    }
}

impl<W: Write> Sink for Ply<W> {
    fn begin(&mut self, parts: &[Part]) -> Result<(), MeshError> {
        one_plain_mesh(parts, "PLY")?;
        let vertices = total(parts, |p| p.count.vertices, "corners", "PLY")?;
        let triangles = total(parts, |p| p.count.triangles, "triangles", "PLY")?;
        self.parts = parts.to_vec();
        let mut first = 0;
        for part in parts {
            self.firsts.push(first);
            first += part.count.vertices as u32;
        }
        let wind = parts.iter().any(|p| p.wind);
        let mut head = String::from("ply\nformat binary_little_endian 1.0\ncomment metres, z up\n");
        head.push_str(&format!("element vertex {vertices}\n"));
        for name in ["x", "y", "z", "nx", "ny", "nz", "s", "t"] {
            head.push_str(&format!("property float {name}\n"));
        }
        for name in ["red", "green", "blue"] {
            head.push_str(&format!("property uchar {name}\n"));
        }
        if wind {
            let vectors = ["pivot", "bend", "parent_pivot", "parent_bend"];
            let axes = vectors.iter().flat_map(|name| ["x", "y", "z"].map(|axis| format!("{name}_{axis}")));
            let numbers = ["level_and_phase", "flutter_and_parent_phase"].map(str::to_owned);
            axes.chain(numbers).for_each(|name| head.push_str(&format!("property float wind_{name}\n")));
        }
        if parts.iter().any(|p| p.growth) {
            for name in ["time", "toward_x", "toward_y", "toward_z"] {
                head.push_str(&format!("property float growth_{name}\n"));
            }
        }
        head.push_str(&format!(
            "element face {triangles}\nproperty list uchar uint vertex_indices\nend_header\n"
        ));
        self.faces.reserve_exact(13 * triangles as usize);
        Ok(self.out.write_all(head.as_bytes())?)
    }

    fn block(&mut self, part: usize, block: &mut Block) -> Result<(), MeshError> {
        let color = self.palette.color(self.parts[part].material).0;
        self.bytes.clear();
        for (i, vertex) in block.vertices.iter().enumerate() {
            self.bytes.extend_from_slice(bytemuck::cast_slice(&vertex.to_array()));
            self.bytes.extend_from_slice(&color);
            if let Some(wind) = block.wind.get(i) {
                self.bytes.extend_from_slice(bytemuck::cast_slice(&wind.to_array()));
            }
            if let Some(emergence) = block.growth.get(i) {
                self.bytes.extend_from_slice(bytemuck::cast_slice(&emergence.to_array()));
            }
        }
        let first = self.firsts[part];
        for triangle in &block.triangles {
            self.faces.push(3);
            triangle.iter().for_each(|i| self.faces.extend_from_slice(&(i + first).to_le_bytes()));
        }
        Ok(self.out.write_all(&self.bytes)?)
    }

    fn end(&mut self) -> Result<(), MeshError> {
        self.out.write_all(&self.faces)?;
        Ok(self.out.flush()?)
    }
}
