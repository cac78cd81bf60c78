//! From sources of triangles to a sink, a few megabytes at a time.

use crate::block::Block;
use crate::part::{Material, MeshError, Sink, Source};
use rayon::prelude::*;
use std::ops::Range;

/// Sends meshes through `sink`, block by block, so that only a few megabytes exist at a time.
///
/// Blocks are made on rayon's threads and arrive in order; what arrives does not depend on the number
/// of threads.
///
/// ```
/// use pleach_mesh::{MeshSettings, Mesher, send, write::obj::Obj};
///
/// let tree = pleach_generators::species("palm")?.grow(1)?;
/// let mut text = Vec::new();
/// send(&[Mesher::new(&tree, MeshSettings::default())], &mut Obj::new(&mut text, "palm", ""))?;
/// assert!(String::from_utf8(text)?.lines().any(|line| line.starts_with("f ")));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// The sink's, or [`MeshError::Empty`].
pub fn send<S: Source>(meshes: &[S], sink: &mut dyn Sink) -> Result<(), MeshError> {
    let mut parts = Vec::new();
    let mut sources = Vec::new();
    for (mesh, source) in meshes.iter().enumerate() {
        for part in source.parts(mesh) {
            sources.push((source, part.material));
            parts.push(part);
        }
    }
    if parts.is_empty() {
        return Err(MeshError::Empty);
    }
    sink.begin(&parts)?;
    for (part, &(source, material)) in sources.iter().enumerate() {
        stream(source, material, |block| sink.block(part, block))?;
    }
    sink.end()
}

/// Makes the blocks of one part, a batch ahead of the one that is taken.
fn stream(
    source: &impl Source,
    material: Material,
    mut take: impl FnMut(&mut Block) -> Result<(), MeshError>,
) -> Result<(), MeshError> {
    let ranges = source.ranges(material);
    let fill = |batch: &[Range<usize>], blocks: &mut Vec<Block>| {
        blocks.resize_with(batch.len(), Block::default);
        blocks.par_iter_mut().zip(batch).for_each(|(block, range)| {
            block.clear();
            source.fill(material, range.clone(), block);
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
