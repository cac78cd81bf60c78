//! From which opacity on a picture is shown, and what is painted where it is not shown.
//!
//! Engines show what is opaque enough and cut the rest out, and from afar they show a smaller picture, each of whose pixels
//! is the mean of many. Of needles a few pixels wide no such pixel is opaque enough at a half: a tree that is leafy close by
//! is bare from across a street. So the bound depends on the picture, and where the shown parts are densest the rest is
//! painted a little less opaque than the bound: it is not seen at the picture's own size, and it lifts the means of the
//! smaller ones.

use crate::picture::Picture;
use pleach_plant::math::lnf;
use rayon::prelude::*;

/// A pixel is part of what the picture shows at its own size from this opacity on.
const SHOWN: f32 = 0.4;
/// Bounds that are tried, in hundredths.
const BOUNDS: [u32; 4] = [40, 38, 36, 34];
/// How much is painted that is not shown, over what is shown.
const AREAS: [f32; 7] = [0.0, 1.0, 1.5, 2.0, 3.0, 5.0, 8.0];
/// Its opacity over the bound.
const BELOW: f32 = 0.95;
/// Pixels around what is shown that stay clear: programs that look between pixels would show a part of them.
const CLEAR: usize = 1;
/// Pixels to each side in which the density of what is shown is measured, twice.
const AROUND: usize = 64;
/// Halvings of the picture that are looked at: a card of 256 pixels has two in the last one.
const HALVINGS: usize = 7;
/// A part of what is covered that is as good as none of it.
const NONE: f32 = 0.08;

/// Prepares `picture` to be cut out, and returns the opacity, from 0 to 1, from which on its pixels are to be shown. At the
/// picture's own size it shows what is opaque by 0.4 or more. It consists of cells of so many pixels, each of which is
/// looked at by itself.
pub(crate) fn cut_out(picture: &mut Picture, cell: [u32; 2]) -> f32 {
    let (across, down) = (picture.width / cell[0].max(1), picture.height / cell[1].max(1));
    let places = (0..across * down).into_par_iter().map(|i| [i % across * cell[0], i / across * cell[1]]);
    let cells: Vec<Cell> = places.filter_map(|place| Cell::new(picture, place, cell)).collect();
    // Rims that are less opaque stay where they are not shown.
    let plain: f32 = cells.par_iter().map(Cell::off).collect::<Vec<_>>().iter().sum();
    let (mut least, mut best) = (plain, None);
    for bound in BOUNDS {
        let bound = bound as f32 / 100.0;
        let areas: Vec<(f32, usize)> = cells.par_iter().map(|cell| cell.best_area(bound)).collect();
        let off = areas.iter().map(|(off, _)| off).sum();
        if off < least {
            (least, best) = (off, Some((bound, areas)));
        }
    }
    let Some((bound, areas)) = best else { return SHOWN };
    for (cell, (_, area)) in cells.iter().zip(areas) {
        cell.paint(picture, bound, area);
    }
    bound
}

/// A part of a picture that shows something.
struct Cell {
    place: [u32; 2],
    size: [u32; 2],
    is_shown: Vec<bool>,
    /// Pixels that are shown, over all.
    covered: f32,
    /// How much is shown of the halved pictures as they are.
    shares: Vec<f32>,
    /// The halved pictures of what is shown.
    sharp: Vec<Vec<f32>>,
    /// Which pixels would be painted, for each of the areas, and halved pictures of that.
    painted: Vec<(Vec<bool>, Vec<Vec<f32>>)>,
}

impl Cell {
    /// `None` where nothing is shown.
    fn new(picture: &Picture, place: [u32; 2], size: [u32; 2]) -> Option<Self> {
        let own = size.map(|side| side as usize);
        let alphas: Vec<f32> =
            pixels(picture.width, place, size).map(|i| f32::from(picture.rgba[4 * i + 3]) / 255.0).collect();
        let is_shown: Vec<bool> = alphas.iter().map(|alpha| *alpha >= SHOWN).collect();
        let count = is_shown.iter().filter(|shown| **shown).count();
        if count == 0 {
            return None;
        }
        let covered = count as f32 / alphas.len() as f32;
        let sharp = alphas.iter().map(|&alpha| if alpha >= SHOWN { alpha } else { 0.0 }).collect();
        let density = Density::new(&is_shown, own);
        let painted = AREAS.map(|area| {
            let painted = density.densest((area * count as f32) as usize);
            let halved = halvings(painted.iter().map(|&is| f32::from(u8::from(is))).collect(), own);
            (painted, halved)
        });
        let shares = halvings(alphas, own).iter().map(|small| share(small, SHOWN)).collect();
        let (sharp, painted) = (halvings(sharp, own), Vec::from(painted));
        Some(Self { place, size, is_shown, covered, shares, sharp, painted })
    }

    /// How far the smaller pictures are from showing as much as the whole one: twice as much is as bad as half as much.
    fn distance(&self, shares: impl Iterator<Item = f32>) -> f32 {
        shares.map(|share| lnf((share / self.covered).max(NONE)).abs()).sum()
    }

    /// That of the cell as it is.
    fn off(&self) -> f32 {
        self.distance(self.shares.iter().copied())
    }

    /// The least distance with this bound, and the number of the area with which it is reached.
    fn best_area(&self, bound: f32) -> (f32, usize) {
        let opacity = BELOW * bound;
        let mut best = (f32::INFINITY, 0);
        for (number, (_, painted)) in self.painted.iter().enumerate() {
            let off = self.distance(self.sharp.iter().zip(painted).map(|(sharp, painted)| {
                let shown = sharp.iter().zip(painted).filter(|(own, part)| *own + opacity * *part >= bound);
                shown.count() as f32 / sharp.len() as f32
            }));
            if off < best.0 {
                best = (off, number);
            }
        }
        best
    }

    fn paint(&self, picture: &mut Picture, bound: f32, area: usize) {
        let opacity = (BELOW * bound * 255.0) as u8;
        let own = pixels(picture.width, self.place, self.size);
        for ((i, is_shown), is_painted) in own.zip(&self.is_shown).zip(&self.painted[area].0) {
            if !is_shown {
                picture.rgba[4 * i + 3] = if *is_painted { opacity } else { 0 };
            }
        }
    }
}

/// The numbers of the pixels of a part of a picture of this width.
fn pixels(width: u32, [left, top]: [u32; 2], [across, down]: [u32; 2]) -> impl Iterator<Item = usize> {
    (top..top + down).flat_map(move |y| (left..left + across).map(move |x| (y * width + x) as usize))
}

/// The part of the pixels that are at least so opaque.
fn share(alphas: &[f32], bound: f32) -> f32 {
    alphas.iter().filter(|alpha| **alpha >= bound).count() as f32 / alphas.len().max(1) as f32
}

/// The picture halved once, twice and so on, without the picture itself.
fn halvings(mut alphas: Vec<f32>, [mut width, mut height]: [usize; 2]) -> Vec<Vec<f32>> {
    let mut all = Vec::new();
    while all.len() < HALVINGS && width > 1 && height > 1 {
        alphas = halved(&alphas, width, height);
        (width, height) = (width / 2, height / 2);
        all.push(alphas.clone());
    }
    all
}

/// Means of four pixels each.
fn halved(alphas: &[f32], width: usize, height: usize) -> Vec<f32> {
    let at = |x: usize, y: usize| alphas[y * width + x];
    let of = |x: usize, y: usize| (at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1)) / 4.0;
    (0..height / 2).flat_map(|y| (0..width / 2).map(move |x| of(2 * x, 2 * y))).collect()
}

/// How much is shown around each pixel.
struct Density {
    /// 0 on what is shown and right beside it.
    around: Vec<u32>,
    /// The same, the largest first.
    ranked: Vec<u32>,
}

impl Density {
    fn new(is_shown: &[bool], size: [usize; 2]) -> Self {
        let shown: Vec<u32> = is_shown.iter().map(|shown| u32::from(*shown)).collect();
        let beside = sums(&shown, size, CLEAR);
        let mut around = sums(&sums(&shown, size, AROUND), size, AROUND);
        around.iter_mut().zip(beside).filter(|(_, beside)| *beside > 0).for_each(|(around, _)| *around = 0);
        let mut ranked = around.clone();
        ranked.sort_unstable_by(|a, b| b.cmp(a));
        Self { around, ranked }
    }

    /// So many pixels beside what is shown, where that is densest, and those that are as dense as the last of them.
    fn densest(&self, count: usize) -> Vec<bool> {
        let least =
            count.checked_sub(1).map_or(u32::MAX, |last| self.ranked[last.min(self.ranked.len() - 1)]);
        self.around.iter().map(|&around| around >= least.max(1)).collect()
    }
}

/// Sums over the squares that reach `far` pixels to each side of each pixel.
fn sums(values: &[u32], [width, height]: [usize; 2], far: usize) -> Vec<u32> {
    let mut rows = vec![0; values.len()];
    for y in 0..height {
        sums_along(far, width, |x| values[y * width + x], |x, sum| rows[y * width + x] = sum);
    }
    let mut all = vec![0; values.len()];
    for x in 0..width {
        sums_along(far, height, |y| rows[y * width + x], |y, sum| all[y * width + x] = sum);
    }
    all
}

fn sums_along(far: usize, length: usize, at: impl Fn(usize) -> u32, mut put: impl FnMut(usize, u32)) {
    let mut sum: u32 = (0..far.min(length)).map(&at).sum();
    for i in 0..length {
        if i + far < length {
            sum += at(i + far);
        }
        put(i, sum);
        if i >= far {
            sum -= at(i - far);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(is_opaque: impl Fn(u32, u32) -> bool) -> Picture {
        let mut picture = Picture::transparent(256, 256);
        for (i, pixel) in (0..).zip(picture.rgba.chunks_exact_mut(4)) {
            pixel[3] = if is_opaque(i % 256, i / 256) { 255 } else { 0 };
        }
        picture
    }

    fn alphas(picture: &Picture) -> Vec<f32> {
        picture.rgba.chunks_exact(4).map(|pixel| f32::from(pixel[3]) / 255.0).collect()
    }

    /// What is shown of the halved pictures with this bound over what is shown of the whole one.
    fn profile(picture: &Picture, bound: f32) -> Vec<f32> {
        let alphas = alphas(picture);
        let whole = share(&alphas, bound);
        halvings(alphas, [256; 2]).iter().map(|small| share(small, bound) / whole).collect()
    }

    #[test]
    fn needles_are_shown_from_afar_as_much_as_close_by() {
        // Around the middle of a cell.
        let needles =
            picture(|x, y| (x + y / 3) % 12 < 2 && (40..216).contains(&x) && (40..216).contains(&y));
        let mut cut = needles.clone();
        let bound = cut_out(&mut cut, [256; 2]);
        assert!((0.34..0.4).contains(&bound), "{bound}");
        // The picture itself shows what it did.
        let shown =
            |picture: &Picture, bound| alphas(picture).iter().map(|a| *a >= bound).collect::<Vec<_>>();
        assert!(shown(&cut, bound) == shown(&needles, SHOWN));
        let (before, after) = (profile(&needles, SHOWN), profile(&cut, bound));
        assert!(before[3] < 0.01, "{before:?}");
        assert!(after[..5].iter().all(|share| (0.7..1.6).contains(share)), "{after:?}");
    }

    #[test]
    fn broad_leaves_keep_their_outline() {
        let mut leaf = picture(|x, y| (32..224).contains(&x) && (32..224).contains(&y));
        // A rim that is half covered stays soft.
        for y in 32..224 {
            leaf.rgba[(y * 256 + 31) * 4 + 3] = 90;
        }
        let before = leaf.clone();
        assert_eq!(cut_out(&mut leaf, [256; 2]), SHOWN);
        assert_eq!(leaf, before);
    }

    #[test]
    fn pictures_of_nothing_stay_as_they_are() {
        for mut nothing in [picture(|_, _| false), Picture::transparent(1, 1)] {
            let (before, size) = (nothing.clone(), [nothing.width, nothing.height]);
            assert_eq!(cut_out(&mut nothing, size), SHOWN);
            assert_eq!(nothing, before);
        }
    }

    #[test]
    fn sums_are_those_of_squares() {
        let values: Vec<u32> = (0..35).map(|i| i * i % 11).collect();
        let all = sums(&values, [7, 5], 2);
        for y in 0..5_usize {
            for x in 0..7_usize {
                let near = |a: usize, b: usize| a.abs_diff(b) <= 2;
                let own =
                    (0..35).filter(|i| near(i % 7, x) && near(i / 7, y)).map(|i| values[i]).sum::<u32>();
                assert_eq!(all[y * 7 + x], own, "{x} {y}");
            }
        }
    }
}
