//! From which opacity on a picture is shown.
//!
//! Engines show what is opaque enough and cut the rest out, and from afar they show a smaller picture, each of whose pixels
//! is the mean of many. Of needles a few pixels wide no such pixel is opaque enough at a half: a tree that is leafy close by
//! is bare from across a street. So the bound depends on the picture: with it about as much is shown of the smaller
//! pictures as is covered.

use crate::picture::Picture;
use pleach_plant::math::lnf;

/// Bounds that are tried, in hundredths. Lower ones would show the rims of what is sharp.
const BOUNDS: std::ops::RangeInclusive<u32> = 12..=40;
/// Halvings of the picture that are looked at: a card of 256 pixels has four in the last one, as of a tree that is about a
/// hundred pixels high.
const HALVINGS: u32 = 6;
/// A part of the picture that is as good as none.
const NONE: f32 = 1e-3;

/// The opacity, from 0 to 1, from which on pixels of `picture` are to be shown.
pub(crate) fn cutoff(picture: &Picture) -> f32 {
    let mut alphas: Vec<f32> =
        picture.rgba.chunks_exact(4).map(|pixel| f32::from(pixel[3]) / 255.0).collect();
    let shown = |alphas: &[f32], bound: f32| {
        alphas.iter().filter(|alpha| **alpha >= bound).count() as f32 / alphas.len().max(1) as f32
    };
    let covered = shown(&alphas, *BOUNDS.end() as f32 / 100.0);
    let (mut width, mut height) = (picture.width as usize, picture.height as usize);
    let mut smaller = Vec::new();
    for _ in 0..HALVINGS {
        if width < 2 || height < 2 {
            break;
        }
        alphas = halved(&alphas, width, height);
        (width, height) = (width / 2, height / 2);
        smaller.push(alphas.clone());
    }
    let off = |bound: u32| -> f32 {
        let shown = |alphas: &Vec<f32>| shown(alphas, bound as f32 / 100.0).max(NONE);
        // Twice as much is as bad as half as much.
        smaller.iter().map(|alphas| lnf(shown(alphas) / covered.max(NONE)).abs()).sum()
    };
    // The highest of those that are as good.
    let mut best = (*BOUNDS.end(), off(*BOUNDS.end()));
    for bound in BOUNDS.rev() {
        let found = off(bound);
        if found < best.1 {
            best = (bound, found);
        }
    }
    best.0 as f32 / 100.0
}

/// Means of four pixels each.
fn halved(alphas: &[f32], width: usize, height: usize) -> Vec<f32> {
    let at = |x: usize, y: usize| alphas[y * width + x];
    let of = |x: usize, y: usize| (at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1)) / 4.0;
    (0..height / 2).flat_map(|y| (0..width / 2).map(move |x| of(2 * x, 2 * y))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(is_opaque: impl Fn(u32, u32) -> bool) -> Picture {
        let mut picture = Picture::transparent(64, 64);
        for (i, pixel) in (0..).zip(picture.rgba.chunks_exact_mut(4)) {
            pixel[3] = if is_opaque(i % 64, i / 64) { 255 } else { 0 };
        }
        picture
    }

    #[test]
    fn needles_are_shown_from_afar_and_broad_leaves_keep_their_outline() {
        let needles = cutoff(&picture(|x, y| (x + y / 3) % 8 < 2));
        assert!((0.12..0.3).contains(&needles), "{needles}");
        let leaf = cutoff(&picture(|x, y| (8..56).contains(&x) && (8..56).contains(&y)));
        assert_eq!(leaf, 0.4);
        assert_eq!(cutoff(&picture(|_, _| false)), 0.4);
        assert_eq!(cutoff(&Picture::transparent(1, 1)), 0.4);
    }
}
