//! Trees of a prior, and what their pictures show whatever their size and place.

use crate::control::interrupt;
use crate::error::FitError;
use crate::posterior::{Prior, features as amounts};
use crate::problem::Genome;
use pleach_silhouette::score::likeness::{Descriptor, Scratch};
use pleach_silhouette::{Bitmap, Detail, Frame, Rasterizer, View};
use pleach_tree::{Tree, Workspace};
use std::ops::Range;
use std::sync::atomic::AtomicBool;

/// Side of the pictures that are learnt from, in pixels: that of goals.
const SIDE: u32 = 256;
/// The height in metres that every tree is brought to before its numbers are learnt.
pub(super) const HEIGHT: f64 = 10.0;
/// The seed of the trees that are learnt from.
const SEED: u64 = 0x6c65_6172;

/// A tree and what is seen of it.
#[derive(Clone, Debug)]
pub(super) struct Example {
    /// The numbers of a tree that is [`HEIGHT`] high.
    pub(super) genome: Genome,
    /// See [`features`].
    pub(super) features: Vec<f64>,
}

/// Trees `numbers` of `prior`, without those that do not grow.
pub(super) fn examples(
    prior: &Prior,
    numbers: Range<u32>,
    stop: &AtomicBool,
) -> Result<Vec<Example>, FitError> {
    let numbers: Vec<u32> = numbers.collect();
    let grown = interrupt::map(&numbers, stop, |&number| example(prior, number))?;
    Ok(grown.into_iter().flatten().collect())
}

fn example(prior: &Prior, number: u32) -> Option<Example> {
    let mut tree = Tree::default();
    let mut genome = prior.genome_into(SEED, number, &mut Workspace::default(), &mut tree).ok()?;
    let parts = prior.species().foliage.into();
    let frame = Frame::automatic(&tree, &View::FRONT, parts, SIDE, SIDE);
    let mut picture = Bitmap::default();
    Rasterizer::for_searches(Detail::Half).draw(&tree, &View::FRONT, &frame, parts, &mut picture);
    let (_, top, _, bottom) = picture.ink_box()?;
    let height = f64::from(bottom + 1 - top) * frame.meters_per_pixel;
    prior.species().generator.resize(&mut genome.values, HEIGHT / height);
    Some(Example { genome, features: features(&picture)? })
}

/// What `picture` shows, whatever its size and margins. `None` of an empty picture.
pub(super) fn features(picture: &Bitmap) -> Option<Vec<f64>> {
    Some(amounts(&[Descriptor::new(&squared(picture)?, &mut Scratch::default())]))
}

/// The tree alone: in the middle of a square, on its lower edge.
fn squared(picture: &Bitmap) -> Option<Bitmap> {
    let (left, top, right, bottom) = picture.ink_box()?;
    let (width, height) = (right + 1 - left, bottom + 1 - top);
    // One part in sixteen is left of the side, so that cells at the edge are blurred as others are.
    let side = (width.max(height) * 16).div_ceil(15);
    let (beside, above) = ((side - width) / 2, side - height);
    let ink = |x: u32, y: u32| {
        let at = x.checked_sub(beside).zip(y.checked_sub(above));
        at.is_some_and(|(x, y)| x < width && y < height && picture.get(left + x, top + y))
    };
    Some(Bitmap::from_fn(side, side, ink))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn margins_change_nothing_and_size_little() {
        let block = |side: u32, left: u32, top: u32, scale: u32| {
            Bitmap::from_fn(side, side, move |x, y| {
                let at = x.checked_sub(left).zip(y.checked_sub(top));
                at.is_some_and(|(x, y)| x < 40 * scale && y < 60 * scale && (x / scale + y / scale) % 9 < 5)
            })
        };
        let own = features(&block(100, 10, 20, 1)).unwrap();
        assert_eq!(own, features(&block(200, 50, 120, 1)).unwrap());
        let larger = features(&block(200, 3, 5, 3)).unwrap();
        let (sum, off) =
            own.iter().zip(&larger).fold((0.0, 0.0), |(s, d), (a, b)| (s + a, d + (a - b).abs()));
        assert!(off / sum < 0.05, "{}", off / sum);
        assert_eq!(features(&Bitmap::new(9, 9)), None);
    }
}
