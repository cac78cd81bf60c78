//! Whether a picture that was split by brightness is a photograph rather than a silhouette.

use super::read::Tones;
use pleach_plant::math;

/// Levels of 255 within which a pixel has its side's tone.
const LIKE: i32 = 40;
/// Part of the pixels of either side that may have another tone: a drawn tree's rims do.
const MAX_ODD: f64 = 0.35;
/// Part of the pixels that may be off the line between the two tones: as colours, not as mixtures.
const MAX_OFF_AXIS: f64 = 0.05;
/// Levels of 255 within which paper is even ...
const EVEN: i32 = 10;
/// ... for at least this part of it; a sky fades.
const MIN_EVEN: f64 = 0.5;
/// Sides with less than this part of the picture say nothing.
const MIN_SIDE: f64 = 0.005;

/// Whether the pixels on either side of the brightness `threshold` have too many tones, or colours, for
/// brightness to separate the tree from its background; `dark_tree` says which side is the tree.
pub(super) fn is_photograph(tones: &Tones, threshold: u8, dark_tree: bool) -> bool {
    let mut heaps = [[0_u64; 256]; 2];
    for &light in &tones.light {
        heaps[usize::from(light > threshold)][usize::from(light)] += 1;
    }
    let pixels = tones.light.len() as f64;
    let middles = heaps.map(|heap| middle(&heap));
    // Part of a side that is farther than `reach` from its median.
    let far = |side: usize, reach: i32| {
        let heap = &heaps[side];
        let is_far = |(level, _): &(i32, &u64)| (level - i32::from(middles[side])).abs() > reach;
        let far: u64 = (0..).zip(heap).filter(is_far).map(|(_, count)| count).sum();
        far as f64 / (heap.iter().sum::<u64>() as f64).max(MIN_SIDE * pixels)
    };
    let paper = usize::from(dark_tree);
    far(paper, EVEN) > 1.0 - MIN_EVEN
        || (0..2).any(|side| far(side, LIKE) > MAX_ODD)
        || off(tones, threshold) > MAX_OFF_AXIS
}

/// The median of a heap of levels.
fn middle(heap: &[u64; 256]) -> u8 {
    let half = heap.iter().sum::<u64>().div_ceil(2);
    let mut below = 0;
    (0..=255)
        .find(|level| {
            below += heap[usize::from(*level)];
            below >= half
        })
        .unwrap_or(255)
}

/// Part of the coloured pixels that are not a mixture of the two sides' median colours.
fn off(tones: &Tones, threshold: u8) -> f64 {
    if tones.colors.is_empty() {
        return 0.0;
    }
    let mut heaps = [[[0_u64; 256]; 3]; 2];
    for (color, light) in tones.colors.iter().zip(tones.light.iter().step_by(tones.stride)) {
        for (heap, value) in heaps[usize::from(*light > threshold)].iter_mut().zip(color) {
            heap[usize::from(*value)] += 1;
        }
    }
    let [from, to] = heaps.map(|channels| channels.map(|heap| f64::from(middle(&heap))));
    let along: [f64; 3] = std::array::from_fn(|i| to[i] - from[i]);
    let length = along.iter().map(|v| v * v).sum::<f64>().max(1.0);
    let is_off = |color: &&[u8; 3]| {
        let at: [f64; 3] = std::array::from_fn(|i| f64::from(color[i]) - from[i]);
        let share = (at.iter().zip(along).map(|(a, b)| a * b).sum::<f64>() / length).clamp(0.0, 1.0);
        at.iter().zip(along).map(|(a, b)| math::powi(a - share * b, 2)).sum::<f64>() > f64::from(LIKE * LIKE)
    };
    tones.colors.iter().filter(is_off).count() as f64 / tones.colors.len() as f64
}
