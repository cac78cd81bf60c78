//! Vertices and triangles as the writers take them.

use glam::{Quat, Vec2, Vec3};

/// A corner of triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vertex {
    /// In metres.
    pub position: Vec3,
    /// Of length 1, outwards.
    pub normal: Vec3,
    /// Texture coordinates, v from the top of a picture to its bottom as in glTF. On bark they count tiles of about
    /// [`crate::BARK_TILE`] metres: u from 0 to a whole number of them around the stem, and v against its direction of
    /// growth, so that pictures stand upright; a fork goes on where its parent is left. Tiles get smaller with the
    /// stem, so that they keep their form. On leaves u runs across and v from the tip (0) to the base (1); both stay
    /// within 0 to 1.
    pub uv: Vec2,
}

impl Vertex {
    /// The eight numbers as files have them: position, normal, texture coordinates.
    #[must_use]
    pub const fn to_array(&self) -> [f32; 8] {
        let Self { position: p, normal: n, uv } = self;
        [p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y]
    }
}

/// What a shader needs to sway a vertex; see [`crate::wind`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wind {
    /// The point about which the corner's stem turns, in metres.
    pub pivot: Vec3,
    /// In turns, 0 to 1.
    pub phase: f32,
    /// Level of the stem, 0 for trunks; leaves have one more than their stem.
    pub level: f32,
    /// Place along the stem or leaf, 0 to 1.
    pub place: f32,
    /// In Hz.
    pub frequency: f32,
    /// In radians.
    pub amplitude: f32,
}

impl Wind {
    /// The eight numbers as files have them, in two groups of four: pivot and phase, then the others in
    /// the order of the fields.
    #[must_use]
    pub const fn to_array(&self) -> [f32; 8] {
        let Self { pivot, phase, level, place, frequency, amplitude } = *self;
        [pivot.x, pivot.y, pivot.z, phase, level, place, frequency, amplitude]
    }
}

/// A run of a part's corners and triangles: what goes through a [`crate::Sink`] at a time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Block {
    /// Corners.
    pub vertices: Vec<Vertex>,
    /// One entry per vertex if wind data was asked for, none otherwise.
    pub wind: Vec<Wind>,
    /// One joint number per vertex if a rig was given, none otherwise.
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
