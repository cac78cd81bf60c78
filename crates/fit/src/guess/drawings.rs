//! Drawings of trees that were grown before: what a library need not grow again.

use super::library::TreeLooks;
use flate2::Compression;
use flate2::read::DeflateDecoder;
use flate2::write::DeflateEncoder;
use std::collections::HashMap;
use std::io::{Read as _, Write as _};
use std::sync::Arc;

/// Drawings of trees, found by what they are drawings of: the generator, its numbers, the seed, the view, and the
/// size of the drawing.
///
/// They spare growing and change nothing: a first guess is the same bits with them and without, so long as they
/// were made by the same version. [`GuessLibrary::record`](super::GuessLibrary::record)
/// makes them.
#[derive(Clone, Debug)]
pub struct Drawings {
    /// How each looks, or that it does not grow, packed, by its mark.
    trees: Arc<HashMap<u64, &'static [u8]>>,
}

/// The drawings are no drawings of this version.
#[derive(Debug, thiserror::Error)]
#[error("no drawings of this version")]
pub struct DrawingsError;

impl Drawings {
    /// Drawings as they were written.
    ///
    /// # Errors
    /// [`DrawingsError`] if they were not.
    pub fn from_bytes(bytes: &'static [u8]) -> Result<Self, DrawingsError> {
        let trees: Vec<(u64, &'static [u8])> = postcard::from_bytes(bytes).map_err(|_| DrawingsError)?;
        Ok(Self { trees: Arc::new(trees.into_iter().collect()) })
    }

    /// How many trees there are drawings of.
    #[must_use]
    pub fn len(&self) -> usize {
        self.trees.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.trees.is_empty()
    }

    /// The looks that are filed under `mark`, none of a tree that does not grow; none if nothing is.
    pub(super) fn find(&self, mark: u64) -> Option<Option<TreeLooks>> {
        postcard::from_bytes(&self.plain(mark)?).ok()
    }

    fn plain(&self, mark: u64) -> Option<Vec<u8>> {
        let mut plain = Vec::new();
        DeflateDecoder::new(*self.trees.get(&mark)?).read_to_end(&mut plain).ok()?;
        Some(plain)
    }

    /// Whether `other` has all of these, and the same.
    #[must_use]
    pub fn are_within(&self, other: &Self) -> bool {
        self.trees.keys().all(|&mark| {
            let one = self.plain(mark);
            one.is_some() && one == other.plain(mark)
        })
    }
}

/// Trees by their marks as [`Drawings::from_bytes`] reads them; the same bytes in whatever order they come.
pub(super) fn pack<'a>(trees: impl Iterator<Item = (u64, &'a Option<TreeLooks>)>) -> Vec<u8> {
    let mut packed: Vec<(u64, Vec<u8>)> = trees.map(|(mark, looks)| (mark, deflated(looks))).collect();
    packed.sort_unstable();
    packed.dedup();
    postcard::to_stdvec(&packed).expect("plain values")
}

fn deflated(looks: &Option<TreeLooks>) -> Vec<u8> {
    let plain = postcard::to_stdvec(looks).expect("plain values");
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(&plain).and_then(|()| encoder.finish()).expect("memory takes all")
}
