//! Vertices and triangles as the writers take them.

use glam::{Quat, Vec3};

/// A corner: position in metres, unit normal, and texture coordinates, as `[x, y, z, nx, ny, nz, u, v]`.
///
/// On bark u is the part of a turn around the stem, 0 to 1, and v runs along it in metres, on through
/// forks. On leaves u runs across and v from the tip (0) to the base (1); both stay within 0 to 1.
pub type Vertex = [f32; 8];

/// What a shader needs to sway a corner, as two groups of four numbers; see [`crate::wind`].
pub type Wind = [f32; 8];

/// A run of a part's corners and triangles: what goes through a [`crate::Sink`] at a time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Block {
    /// Corners.
    pub vertices: Vec<Vertex>,
    /// One entry a corner if wind data was asked for, none otherwise.
    pub wind: Vec<Wind>,
    /// One joint number a corner if a rig was given, none otherwise.
    pub joints: Vec<u16>,
    /// Placements of the part's shape, if it is drawn by instances.
    pub instances: Vec<Placement>,
    /// Triangles by corner numbers that count from the part's first corner; counter-clockwise from
    /// outside. They name corners of this block only.
    pub triangles: Vec<[u32; 3]>,
}

impl Block {
    /// Drops the content and keeps the memory.
    pub fn clear(&mut self) {
        self.vertices.clear();
        self.wind.clear();
        self.joints.clear();
        self.instances.clear();
        self.triangles.clear();
    }
}

/// Where one instance of a shape stands: scaled, then turned, then moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// In metres.
    pub translation: Vec3,
    /// Unit quaternion.
    pub rotation: Quat,
    /// Along the shape's own axes.
    pub scale: Vec3,
}

/// Position of a corner.
#[must_use]
pub fn position(vertex: &Vertex) -> Vec3 {
    Vec3::new(vertex[0], vertex[1], vertex[2])
}

/// Normal of a corner.
#[must_use]
pub fn normal(vertex: &Vertex) -> Vec3 {
    Vec3::new(vertex[3], vertex[4], vertex[5])
}

/// A corner from its parts.
pub(crate) fn vertex(position: Vec3, normal: Vec3, u: f32, v: f32) -> Vertex {
    [position.x, position.y, position.z, normal.x, normal.y, normal.z, u, v]
}
