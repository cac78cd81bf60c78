//! Binary STL: triangles with their normals, z up, metres.

use super::{one_plain_mesh, total};
use crate::block::Block;
use crate::part::{MeshError, Part, Sink};
use std::io::Write;

/// Writes binary STL.
#[derive(Debug)]
pub struct Stl<W> {
    out: W,
    firsts: Vec<u32>,
    bytes: Vec<u8>,
}

impl<W: Write> Stl<W> {
    /// Writes to `out`, which should be buffered.
    pub const fn new(out: W) -> Self {
        Self { out, firsts: Vec::new(), bytes: Vec::new() }
    }
}

impl<W: Write> Sink for Stl<W> {
    fn begin(&mut self, parts: &[Part]) -> Result<(), MeshError> {
        one_plain_mesh(parts, "STL")?;
        let count = total(parts, |p| p.count.triangles, "triangles", "STL")?;
        self.firsts = vec![0; parts.len()];
        // Not "solid": that would announce the text format.
        let mut head = [0; 80];
        head[..25].copy_from_slice(b"binary STL, metres, z up ");
        self.out.write_all(&head)?;
        Ok(self.out.write_all(&count.to_le_bytes())?)
    }

    fn block(&mut self, part: usize, block: &mut Block) -> Result<(), MeshError> {
        self.bytes.clear();
        let first = &mut self.firsts[part];
        for triangle in &block.triangles {
            let [a, b, c] = triangle.map(|i| block.vertices[(i - *first) as usize].position);
            let normal = (b - a).cross(c - a).normalize_or_zero();
            for v in [normal, a, b, c] {
                self.bytes.extend_from_slice(bytemuck::cast_slice(&v.to_array()));
            }
            self.bytes.extend_from_slice(&[0, 0]);
        }
        *first += block.vertices.len() as u32;
        Ok(self.out.write_all(&self.bytes)?)
    }

    fn end(&mut self) -> Result<(), MeshError> {
        Ok(self.out.flush()?)
    }
}
