//! Where meshes go.

use crate::block::Block;
use crate::mesher::Mesher;
use crate::tube::Count;
use rayon::prelude::*;

/// What a part is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Material {
    /// Stems.
    Bark,
    /// Leaves.
    Leaf,
    /// Blossoms.
    Blossom,
    /// Upright cards that show a picture of the whole tree.
    Card,
}

impl Material {
    /// Those of a meshed tree, in the order of its parts.
    pub const ALL: [Self; 3] = [Self::Bark, Self::Leaf, Self::Blossom];

    /// The material's name in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Bark => "bark",
            Self::Leaf => "leaves",
            Self::Blossom => "blossom",
            Self::Card => "card",
        }
    }
}

/// What a sink is told of a part before its blocks come.
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
    /// Whether joint numbers come with the corners.
    pub rigged: bool,
}

/// Why a mesh could not be written.
#[derive(Debug, thiserror::Error)]
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

/// Receives a mesh: all parts announced, then blocks of each part in order, then the end.
///
/// A sink that is dropped before [`Sink::end`] has failed; what it wrote until then is no file.
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

/// Sends meshes through `sink`, block by block, so that only a few megabytes exist at a time.
///
/// Blocks are made on rayon's threads and arrive in order; what arrives does not depend on the number
/// of threads.
///
/// # Errors
/// The sink's, or [`MeshError::Empty`].
pub fn send(meshes: &[Mesher<'_>], sink: &mut dyn Sink) -> Result<(), MeshError> {
    let mut parts = Vec::new();
    let mut sources = Vec::new();
    for (mesh, mesher) in meshes.iter().enumerate() {
        for part in mesher.parts(mesh) {
            sources.push((mesher, part.material));
            parts.push(part);
        }
    }
    if parts.is_empty() {
        return Err(MeshError::Empty);
    }
    sink.begin(&parts)?;
    for (part, &(mesher, material)) in sources.iter().enumerate() {
        stream(mesher, material, |block| sink.block(part, block))?;
    }
    sink.end()
}

/// Makes the blocks of one part, a batch ahead of the one that is taken.
fn stream(
    mesher: &Mesher<'_>,
    material: Material,
    mut take: impl FnMut(&mut Block) -> Result<(), MeshError>,
) -> Result<(), MeshError> {
    let ranges = mesher.ranges(material);
    let fill = |batch: &[std::ops::Range<usize>], blocks: &mut Vec<Block>| {
        blocks.resize_with(batch.len(), Block::default);
        blocks.par_iter_mut().zip(batch).for_each(|(block, range)| {
            block.clear();
            mesher.fill(material, range.clone(), block);
        });
    };
    let size = 2 * rayon::current_num_threads().clamp(1, 16);
    let mut batches = ranges.chunks(size);
    let (mut ready, mut coming) = (Vec::new(), Vec::new());
    let Some(first) = batches.next() else { return Ok(()) };
    fill(first, &mut ready);
    loop {
        let next = batches.next();
        // Taking stays on this thread; the next batch is made by the others meanwhile.
        let result = rayon::in_place_scope(|scope| {
            if let Some(next) = next {
                let coming = &mut coming;
                scope.spawn(move |_| fill(next, coming));
            }
            ready.iter_mut().try_for_each(&mut take)
        });
        result?;
        if next.is_none() {
            return Ok(());
        }
        std::mem::swap(&mut ready, &mut coming);
    }
}
