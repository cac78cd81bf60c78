//! Positions, normals and texture coordinates as whole numbers (`KHR_mesh_quantization`).

use super::upright;
use crate::block::{Block, Placement, Vertex};
use crate::part::{Material, MeshError, Part, Sink, Source};
use crate::stream::send;
use glam::{Vec2, Vec3};

/// How many materials there are.
const MATERIALS: usize = Material::Collision as usize + 1;
/// The largest number of 16 bits.
const MOST: f32 = 65_535.0;

/// What the whole numbers of a file stand for.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Where the position 0, 0, 0 is, in metres, y up.
    pub(super) origin: Vec3,
    /// Metres between a number and the next.
    pub(super) step: f32,
    /// Of each material the texture coordinates of 0, and how much more those of the largest number are.
    tiles: [(Vec2, Vec2); MATERIALS],
}

impl Grid {
    /// The finest that holds `meshes`: 65,536 numbers along their longest side, and along both texture coordinates of
    /// each material.
    ///
    /// # Errors
    /// [`MeshError::Empty`].
    pub fn new<S: Source>(meshes: &[S]) -> Result<Self, MeshError> {
        let mut bounds = Bounds::default();
        send(meshes, &mut bounds)?;
        let (low, high) = bounds.positions.unwrap_or_default();
        let tiles = bounds.tiles.map(|tiles| {
            let (low, high) = tiles.unwrap_or_default();
            // Within a picture the numbers are those of the picture.
            let is_inside = low.min_element() >= 0.0 && high.max_element() <= 1.0;
            if is_inside { (Vec2::ZERO, Vec2::ONE) } else { (low, (high - low).max(Vec2::splat(1e-6))) }
        });
        Ok(Self { origin: low, step: ((high - low).max_element() / MOST).max(1e-9), tiles })
    }

    /// The texture coordinates of 0 of a material, and how much more those of the largest number are; `None` where the
    /// numbers are those of the picture.
    pub(super) fn tiles(&self, material: Material) -> Option<(Vec2, Vec2)> {
        Some(self.tiles[material as usize]).filter(|tiles| *tiles != (Vec2::ZERO, Vec2::ONE))
    }

    /// A position as whole numbers.
    pub(super) fn position(&self, position: Vec3) -> [u16; 3] {
        ((position - self.origin) / self.step)
            .round()
            .clamp(Vec3::ZERO, Vec3::splat(MOST))
            .to_array()
            .map(|x| x as u16)
    }

    /// Where a mesh of whole numbers is to stand, so that it is where `placement` puts the mesh that they stand for.
    pub(super) fn placement(&self, placement: &Placement) -> Placement {
        let Placement { translation, rotation, scale } = *placement;
        Placement {
            translation: translation + rotation * (scale * self.origin),
            rotation,
            scale: scale * self.step,
        }
    }
}

/// How the vertices of a part are written.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Form {
    /// Eight floats.
    #[default]
    Floats,
    /// Position of 16 bits or as floats, normal of 8 bits, texture coordinates of 16 bits or none.
    Numbers {
        /// Whether positions are whole numbers.
        has_grid: bool,
        /// What texture coordinates are counted from, and in, where a picture is shown.
        tiles: Option<(Vec2, Vec2)>,
    },
}

impl Form {
    /// That of a part. One shape of many places stays as it is in space, since it is small and has no node of its own.
    pub(super) fn new(grid: Option<&Grid>, part: &Part, has_picture: bool) -> Self {
        let Some(grid) = grid else { return Self::Floats };
        // Only a picture can say that it is to be moved and scaled.
        let tiles = has_picture.then_some(grid.tiles[part.material as usize]);
        Self::Numbers { has_grid: part.instances == 0, tiles }
    }

    /// Bytes of a vertex, and where in it normal and texture coordinates are.
    pub(super) const fn sizes(self) -> (u64, u64, u64) {
        match self {
            Self::Floats => (32, 12, 24),
            Self::Numbers { has_grid, tiles } => {
                let normal = if has_grid { 8 } else { 12 };
                (normal + 4 + if tiles.is_some() { 4 } else { 0 }, normal, normal + 4)
            }
        }
    }

    pub(super) fn stride(self) -> u64 {
        self.sizes().0
    }

    /// Bytes of a tangent.
    pub(super) const fn tangent_bytes(self) -> u64 {
        if matches!(self, Self::Floats) { 16 } else { 4 }
    }

    /// The bytes of vertices.
    pub(super) fn vertices(self, grid: Option<&Grid>, vertices: &[Vertex]) -> Vec<u8> {
        let (Self::Numbers { has_grid, tiles }, Some(grid)) = (self, grid) else {
            let floats: Vec<[f32; 8]> = vertices.iter().map(Vertex::to_array).collect();
            return bytemuck::cast_slice(&floats).to_vec();
        };
        let mut bytes = Vec::with_capacity(vertices.len() * self.stride() as usize);
        for vertex in vertices {
            if has_grid {
                let [x, y, z] = grid.position(vertex.position);
                bytes.extend_from_slice(bytemuck::cast_slice(&[x, y, z, 0]));
            } else {
                bytes.extend_from_slice(bytemuck::cast_slice(&vertex.position.to_array()));
            }
            let [x, y, z] = vertex.normal.to_array().map(small);
            bytes.extend_from_slice(&[x, y, z, 0]);
            if let Some((low, size)) = tiles {
                let at = ((vertex.uv - low) / size).clamp(Vec2::ZERO, Vec2::ONE) * MOST;
                bytes.extend_from_slice(bytemuck::cast_slice(&at.round().to_array().map(|x| x as u16)));
            }
        }
        bytes
    }

    /// The bytes of tangents.
    pub(super) fn tangents(self, tangents: &[[f32; 4]]) -> Vec<u8> {
        match self {
            Self::Floats => bytemuck::cast_slice(tangents).to_vec(),
            Self::Numbers { .. } => tangents.iter().flat_map(|tangent| tangent.map(small)).collect(),
        }
    }
}

/// A number from −1 to 1 in 8 bits.
fn small(x: f32) -> u8 {
    (127.0 * x).round().clamp(-127.0, 127.0) as i8 as u8
}

/// Bounds of positions, y up, and of texture coordinates of each material.
#[derive(Default)]
struct Bounds {
    parts: Vec<Part>,
    positions: Option<(Vec3, Vec3)>,
    tiles: [Option<(Vec2, Vec2)>; MATERIALS],
}

impl Sink for Bounds {
    fn begin(&mut self, parts: &[Part]) -> Result<(), MeshError> {
        self.parts = parts.to_vec();
        Ok(())
    }

    fn block(&mut self, part: usize, block: &mut Block) -> Result<(), MeshError> {
        let part = self.parts[part];
        let tiles = &mut self.tiles[part.material as usize];
        for vertex in &block.vertices {
            let (low, high) = tiles.unwrap_or((vertex.uv, vertex.uv));
            *tiles = Some((low.min(vertex.uv), high.max(vertex.uv)));
            if part.instances == 0 {
                let at = upright(vertex.position);
                let (low, high) = self.positions.unwrap_or((at, at));
                self.positions = Some((low.min(at), high.max(at)));
            }
        }
        Ok(())
    }

    fn end(&mut self) -> Result<(), MeshError> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Quat, vec3};

    #[test]
    fn a_mesh_of_whole_numbers_stands_where_the_mesh_does() {
        let grid =
            Grid { origin: vec3(-3.0, 0.5, 2.0), step: 1e-4, tiles: [(Vec2::ZERO, Vec2::ONE); MATERIALS] };
        let placement = Placement {
            translation: vec3(1.0, 2.0, 3.0),
            rotation: Quat::from_rotation_y(0.7),
            scale: Vec3::splat(1.3),
        };
        let put = |placement: &Placement, at: Vec3| {
            placement.translation + placement.rotation * (placement.scale * at)
        };
        for at in [vec3(-3.0, 0.5, 2.0), vec3(-1.2, 3.1, 4.7), vec3(0.33, 2.2, 2.9)] {
            let numbers = Vec3::from_array(grid.position(at).map(f32::from));
            let off = put(&grid.placement(&placement), numbers).distance(put(&placement, at));
            assert!(off < 1e-4 * 1.3, "{off}");
        }
    }
}
