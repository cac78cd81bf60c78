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
    /// within 0 to 1. On blobs they count tiles of [`crate::BLOB_TILE`] metres where there are pictures and no leaves.
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
    /// The point about which the vertex' own body turns, in metres.
    pub pivot: Vec3,
    /// Along the body, as long as the radians by which each metre of it turns in a fresh breeze.
    pub bend: Vec3,
    /// Of the body, in turns, 0 to less than 1.
    pub phase: f32,
    /// The point about which the body that carries it turns, in metres.
    pub parent_pivot: Vec3,
    /// As `bend`, of the body that carries it.
    pub parent_bend: Vec3,
    /// As `phase`, of the body that carries it.
    pub parent_phase: f32,
    /// 0 for trunks, 1 for limbs, 2 for twigs and all that they carry.
    pub level: f32,
    /// How far the vertex flutters along its normal, in metres: 0 but for leaves and cards.
    pub flutter: f32,
}

impl Wind {
    /// The fourteen numbers as files have them. Flutter is rounded to millimetres.
    #[must_use]
    pub fn to_array(&self) -> [f32; 14] {
        let Self { pivot: p, bend: b, parent_pivot: pp, parent_bend: pb, .. } = self;
        let own = self.level + self.phase;
        let parent = (1000.0 * self.flutter).round() + self.parent_phase;
        [p.x, p.y, p.z, b.x, b.y, b.z, pp.x, pp.y, pp.z, pb.x, pb.y, pb.z, own, parent]
    }
}

/// When a vertex comes to be, and from where; see [`crate::growth`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Emergence {
    /// When the place that it comes from is there, 0 to [`crate::growth::LAST`].
    pub time: f32,
    /// From the vertex to that place, in metres.
    pub toward: Vec3,
}

impl Emergence {
    /// The four numbers as files have them.
    #[must_use]
    pub const fn to_array(&self) -> [f32; 4] {
        let Self { time, toward: t } = self;
        [*time, t.x, t.y, t.z]
    }
}

/// A run of a part's corners and triangles: what goes through a [`crate::Sink`] at a time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Block {
    /// Corners.
    pub vertices: Vec<Vertex>,
    /// One entry per vertex if wind data was asked for, none otherwise.
    pub wind: Vec<Wind>,
    /// One entry per vertex if growth data was asked for, none otherwise.
    pub growth: Vec<Emergence>,
    /// One entry per vertex if pivots were given, none otherwise: texture coordinates of the pixel of its element; see
    /// [`crate::pivots`].
    pub pixels: Vec<Vec2>,
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
        self.growth.clear();
        self.pixels.clear();
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
