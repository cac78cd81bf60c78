//! Where triangles come from, in parts of one material, and where they go.

use crate::block::Block;
use std::ops::Range;

/// How many corners and triangles something has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// Corners.
    pub vertices: u64,
    /// Triangles.
    pub triangles: u64,
}

impl std::ops::AddAssign for Count {
    fn add_assign(&mut self, other: Self) {
        self.vertices += other.vertices;
        self.triangles += other.triangles;
    }
}

/// What a part is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Material {
    /// Stems.
    Bark,
    /// Leaves.
    Leaf,
    /// Blossoms.
    Blossom,
    /// Cards that show pictures of twigs with their leaves.
    Twig,
    /// Upright cards that show a picture of the whole tree.
    Card,
    /// What things bump into.
    Collision,
}

impl Material {
    /// Those of a meshed tree, in the order of its parts.
    pub const ALL: [Self; 4] = [Self::Bark, Self::Leaf, Self::Blossom, Self::Twig];

    /// The material's name in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Bark => "bark",
            Self::Leaf => "leaves",
            Self::Blossom => "blossom",
            Self::Twig => "twigs",
            Self::Card => "card",
            Self::Collision => "collision",
        }
    }
}

/// What a sink knows of a part before its blocks come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// Number of the mesh that it belongs to: a level of detail, or a variant in a forest.
    pub mesh: usize,
    /// What it is made of.
    pub material: Material,
    /// Corners and triangles to come.
    pub count: Count,
    /// Placements to come; 0 where the part is drawn once, as it is.
    pub instances: u64,
    /// Whether wind data come with the corners.
    pub wind: bool,
    /// Whether growth data come with the corners.
    pub growth: bool,
    /// Whether texture coordinates of pixels of pivots come with the corners.
    pub pixels: bool,
    /// Whether joint numbers come with the corners.
    pub rigged: bool,
}

impl Part {
    /// A part of triangles whose corners have neither wind data nor growth data nor pixels nor joints.
    #[must_use]
    pub const fn plain(mesh: usize, material: Material, count: Count) -> Self {
        Self { mesh, material, count, instances: 0, wind: false, growth: false, pixels: false, rigged: false }
    }
}

/// Why a mesh could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// The system refused: a full disk, a closed pipe.
    #[error("{0}")]
    Io(#[from] std::io::Error),
    /// More than the format can count.
    #[error(
        "the mesh has {found} {what}, {format} holds at most {limit}; a coarser tolerance, fewer levels, or instances"
    )]
    TooLarge {
        /// What there is too much of.
        what: &'static str,
        /// How much there is.
        found: u64,
        /// How much there may be.
        limit: u64,
        /// The format.
        format: &'static str,
    },
    /// The format has no way to say this.
    #[error("{format} cannot hold {what}")]
    Unsupported {
        /// What was asked for.
        what: &'static str,
        /// The format.
        format: &'static str,
    },
    /// A tree without a single triangle.
    #[error("there is nothing to write: the tree has no stem that is long enough and no leaves")]
    Empty,
}

/// Has a mesh in parts, whose sizes it knows beforehand and whose triangles it makes a run at a time.
pub trait Source: Sync {
    /// Its parts that are not empty, one for each material at most, as mesh number `mesh`.
    fn parts(&self, mesh: usize) -> Vec<Part>;

    /// The runs that make up the part of this material, in order: each is a block of some hundred
    /// kilobytes.
    fn ranges(&self, material: Material) -> Vec<Range<usize>>;

    /// Appends the run `range`, one of [`Source::ranges`], to `block`.
    fn fill(&self, material: Material, range: Range<usize>, block: &mut Block);
}

impl<T: Source + ?Sized> Source for Box<T> {
    fn parts(&self, mesh: usize) -> Vec<Part> {
        (**self).parts(mesh)
    }

    fn ranges(&self, material: Material) -> Vec<Range<usize>> {
        (**self).ranges(material)
    }

    fn fill(&self, material: Material, range: Range<usize>, block: &mut Block) {
        (**self).fill(material, range, block);
    }
}

/// Receives a mesh: all parts announced, then blocks of each part in order, then the end.
///
/// A sink that is dropped before [`Sink::end`] has failed; what it wrote until then is not a complete file.
pub trait Sink {
    /// The parts to come, none of them empty.
    ///
    /// # Errors
    /// If the format cannot hold them, or the system refuses.
    fn begin(&mut self, parts: &[Part]) -> Result<(), MeshError>;

    /// The next block of part number `part`. The sink may change the block: its caller drops it.
    ///
    /// # Errors
    /// If the system refuses.
    fn block(&mut self, part: usize, block: &mut Block) -> Result<(), MeshError>;

    /// Nothing more will come.
    ///
    /// # Errors
    /// If the system refuses.
    fn end(&mut self) -> Result<(), MeshError>;
}
