//! Drawings of trees that a library need not grow again.

use super::silhouettes::BothSilhouettes;
use flate2::Compression;
use flate2::read::DeflateDecoder;
use flate2::write::DeflateEncoder;
use std::collections::HashMap;
use std::io::{Read as _, Write as _};
use std::sync::Arc;

/// Drawings of trees by generator, numbers, seed, view, and size of the drawing.
///
/// They save time and do not change a first guess, provided that the same version made them.
/// [`GuessLibrary::record`](super::GuessLibrary::record) makes them.
#[derive(Clone, Debug)]
pub struct Drawings {
    /// Packed silhouettes of each, or that it does not grow, by its key.
    trees: Arc<HashMap<u64, &'static [u8]>>,
}

/// The drawings are not of this version.
#[derive(Debug, thiserror::Error)]
#[error("no drawings of this version")]
pub struct DrawingsError;

impl Drawings {
    /// Reads the bytes of [`GuessLibrary::record`](super::GuessLibrary::record).
    ///
    /// # Errors
    /// [`DrawingsError`] for other bytes.
    pub fn from_bytes(bytes: &'static [u8]) -> Result<Self, DrawingsError> {
        let trees: Vec<(u64, &'static [u8])> = postcard::from_bytes(bytes).map_err(|_| DrawingsError)?;
        Ok(Self { trees: Arc::new(trees.into_iter().collect()) })
    }

    /// The number of trees.
    #[must_use]
    pub fn len(&self) -> usize {
        self.trees.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.trees.is_empty()
    }

    /// The silhouettes with this key: `Some(None)` for trees that do not grow, `None` for an unknown key.
    pub(super) fn find(&self, mark: u64) -> Option<Option<BothSilhouettes>> {
        postcard::from_bytes(&self.plain(mark)?).ok()
    }

    fn plain(&self, mark: u64) -> Option<Vec<u8>> {
        let mut plain = Vec::new();
        DeflateDecoder::new(*self.trees.get(&mark)?).read_to_end(&mut plain).ok()?;
        Some(plain)
    }

    /// Whether `other` contains all of these, unchanged.
    #[must_use]
    pub fn are_within(&self, other: &Self) -> bool {
        self.trees.keys().all(|&mark| {
            let one = self.plain(mark);
            one.is_some() && one == other.plain(mark)
        })
    }
}

/// The bytes of trees by their keys, which do not depend on their order.
pub(super) fn pack<'a>(trees: impl Iterator<Item = (u64, &'a Option<BothSilhouettes>)>) -> Vec<u8> {
    let mut packed: Vec<(u64, Vec<u8>)> =
        trees.map(|(mark, silhouettes)| (mark, deflated(silhouettes))).collect();
    packed.sort_unstable();
    packed.dedup();
    postcard::to_stdvec(&packed).expect("plain values")
}

fn deflated(silhouettes: &Option<BothSilhouettes>) -> Vec<u8> {
    let plain = postcard::to_stdvec(silhouettes).expect("plain values");
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(&plain).and_then(|()| encoder.finish()).expect("memory takes all")
}
