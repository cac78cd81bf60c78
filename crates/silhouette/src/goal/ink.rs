//! What in a picture is tree: opacity, or brightness split in two.

use super::alpha::{self, Alpha, OPAQUE};
use super::border;
use super::read::Tones;
use super::warning::GoalWarning;
use crate::bitmap::Bitmap;

/// Which of the two tones of a picture is the tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Polarity {
    /// The tone that the picture's edge does not have; with an alpha channel, what is opaque.
    #[default]
    Auto,
    /// Dark tree on light paper. Transparent parts count as paper.
    DarkTree,
    /// Light tree on dark paper, as most masks are. Transparent parts count as paper.
    LightTree,
}

/// How tree and paper were separated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Split {
    /// The tree is what is at least half opaque, or the hole in it.
    Opacity,
    /// The tree is what is on one side of a brightness.
    Brightness {
        /// The greatest brightness, 0 to 255, of the dark part (Otsu's threshold).
        threshold: u8,
        /// Whether the dark part is the tree.
        dark_tree: bool,
    },
    /// By colour, since brightness was not enough.
    Color,
    /// The picture was one-bit already.
    None,
}

/// Tones closer than this make an even picture.
const MIN_CONTRAST: u8 = 16;
/// Opacities farther apart than this make an alpha channel that says something.
pub(crate) const MIN_ALPHA_RANGE: u8 = 128;

/// What was made of a picture.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Reading {
    /// The tree, continued over what is not of the picture.
    pub(crate) ink: Bitmap,
    pub(crate) split: Split,
    /// The pixels that are of the picture; all if there is none.
    pub(crate) inside: Option<Bitmap>,
    /// What was done to the picture on the way.
    pub(crate) warnings: Vec<GoalWarning>,
}

/// A picture has several tones, but so near to each other that no split can be trusted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LowContrast {
    /// The least brightness, 0 to 255.
    pub(crate) darkest: u8,
    /// The greatest.
    pub(crate) lightest: u8,
}

/// The tree in a picture, and how it was separated from the paper. What is not of the picture, such as a frame,
/// gets the tones of what is next to it.
pub(crate) fn ink_of(tones: &mut Tones, polarity: Polarity) -> Result<Reading, LowContrast> {
    let mut warnings = Vec::new();
    let mut inside = None;
    let least = tones.opacity.iter().copied().min().unwrap_or(255);
    let most = tones.opacity.iter().copied().max().unwrap_or(255);
    if polarity == Polarity::Auto && most - least >= MIN_ALPHA_RANGE {
        let opaque = bitmap(tones, |i| tones.opacity[i] >= OPAQUE);
        let width = tones.width as usize;
        match alpha::role(&opaque, |x, y| tones.light[y as usize * width + x as usize]) {
            Alpha::Tree => {
                return Ok(Reading { ink: opaque, split: Split::Opacity, inside, warnings });
            }
            Alpha::Around => {
                let ink = bitmap(tones, |i| tones.opacity[i] < OPAQUE);
                warnings.push(GoalWarning::TransparentTree);
                return Ok(Reading { ink, split: Split::Opacity, inside, warnings });
            }
            Alpha::Picture => {
                let opacity = |x: u32, y: u32| tones.opacity[y as usize * width + x as usize];
                let certain = alpha::certain(tones.width, tones.height, opacity);
                warnings.push(GoalWarning::AlphaIgnored {
                    transparent: 1.0 - opaque.ink() as f64 / opaque.area() as f64,
                });
                border::extend(&mut tones.light, &certain);
                tones.opacity.fill(255);
                inside = Some(certain);
            }
        }
    }
    // Transparent parts show the paper: white under a dark tree, black under a light one.
    let paper = if polarity == Polarity::LightTree { 0 } else { 255 };
    let mut brightness: Vec<u8> =
        tones.light.iter().zip(&tones.opacity).map(|(&l, &a)| over(l, a, paper)).collect();
    if let Some(frame) = border::frame(&brightness, tones.width, tones.height) {
        let picture = frame.inside(tones.width, tones.height);
        border::extend(&mut brightness, &picture);
        border::extend(&mut tones.light, &picture);
        inside = Some(inside.map_or_else(|| picture.clone(), |other| border::within(&other, &picture)));
        warnings.push(GoalWarning::Frame(frame));
    }
    let mut histogram = [0_u64; 256];
    for &b in &brightness {
        histogram[usize::from(b)] += 1;
    }
    let threshold = threshold(&histogram)?;
    let dark = bitmap(tones, |i| brightness[i] <= threshold);
    let dark_tree = match polarity {
        Polarity::DarkTree => true,
        Polarity::LightTree => false,
        Polarity::Auto => dark.ink() == dark.area() || !edge_is_ink(&dark),
    };
    let ink = if dark_tree { dark } else { bitmap(tones, |i| brightness[i] > threshold) };
    Ok(Reading { ink, split: Split::Brightness { threshold, dark_tree }, inside, warnings })
}

/// The greatest brightness of the dark part: between two values if there are no more, however near they
/// are; anything if there is one; else Otsu's.
fn threshold(histogram: &[u64; 256]) -> Result<u8, LowContrast> {
    let levels: Vec<u8> = (0..=255).filter(|&level| histogram[usize::from(level)] > 0).collect();
    match levels[..] {
        [darkest, lightest] => Ok(darkest.midpoint(lightest)),
        [darkest, .., lightest] => otsu(histogram).ok_or(LowContrast { darkest, lightest }),
        _ => Ok(127),
    }
}

fn over(light: u8, opacity: u8, paper: u8) -> u8 {
    let (l, a, p) = (u32::from(light), u32::from(opacity), u32::from(paper));
    ((l * a + p * (255 - a) + 127) / 255) as u8
}

fn bitmap(tones: &Tones, ink: impl Fn(usize) -> bool) -> Bitmap {
    let width = tones.width as usize;
    Bitmap::from_fn(tones.width, tones.height, |x, y| ink(y as usize * width + x as usize))
}

/// The brightness that best splits a histogram in two: the greatest of the dark part; `None` if all is
/// of about one brightness.
///
/// Otsu, "A threshold selection method from gray-level histograms" (1979): the split with the
/// greatest variance between the parts. Where several are equal, as between pure black and white,
/// the middle one.
pub(crate) fn otsu(histogram: &[u64; 256]) -> Option<u8> {
    let darkest = histogram.iter().position(|&n| n > 0)?;
    let lightest = histogram.iter().rposition(|&n| n > 0)?;
    if lightest - darkest < usize::from(MIN_CONTRAST) {
        return None;
    }
    let total: u64 = histogram.iter().sum();
    let sum: u64 = histogram.iter().zip(0..).map(|(&n, level)| n * level).sum();
    let (mut below, mut sum_below) = (0_u64, 0_u64);
    let (mut best, mut first, mut last) = (-1.0_f64, 0_usize, 0_usize);
    for (level, &count) in histogram.iter().enumerate().take(lightest).skip(darkest) {
        below += count;
        sum_below += count * level as u64;
        let (n0, n1) = (below as f64, (total - below) as f64);
        let gap = sum_below as f64 / n0 - (sum - sum_below) as f64 / n1;
        let between = n0 * n1 * gap * gap;
        if between > best * (1.0 + 1e-12) {
            (best, first, last) = (between, level, level);
        } else if between >= best * (1.0 - 1e-12) {
            last = level;
        }
    }
    Some(((first + last) / 2) as u8)
}

/// Whether the picture's edge is mostly ink: left, right and top, since trees stand on the bottom.
/// Where the edge is undecided, the two top corners say.
fn edge_is_ink(ink: &Bitmap) -> bool {
    let (w, h) = (ink.width(), ink.height());
    let (mut inked, mut all) = (0_u64, 0_u64);
    let mut count = |x, y| {
        inked += u64::from(ink.get(x, y));
        all += 1;
    };
    (0..w).for_each(|x| count(x, 0));
    (1..h).for_each(|y| {
        count(0, y);
        count(w - 1, y);
    });
    let share = inked as f64 / all as f64;
    if (share - 0.5).abs() > 0.15 {
        return share > 0.5;
    }
    let (cw, ch) = (w.div_ceil(16), h.div_ceil(16));
    let corner = |left: u32| (0..ch).flat_map(move |y| (left..left + cw).map(move |x| (x, y)));
    let inked = corner(0).chain(corner(w - cw)).filter(|&(x, y)| ink.get(x, y)).count();
    inked as u32 > cw * ch
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tones(width: u32, height: u32, light: impl Fn(u32, u32) -> (u8, u8)) -> Tones {
        let at = |i: u32| light(i % width, i / width);
        let (light, opacity) = (0..width * height).map(at).unzip();
        Tones { width, height, light, opacity, colors: Vec::new(), stride: 1, several: false }
    }

    /// A trunk on the bottom edge.
    fn tree(x: u32, y: u32) -> bool {
        (8..12).contains(&x) && y > 5
    }

    /// Reads a picture that has enough contrast.
    fn read(mut t: Tones, polarity: Polarity) -> (Bitmap, Split) {
        let reading = ink_of(&mut t, polarity).unwrap();
        assert_eq!((reading.inside, reading.warnings), (None, vec![]));
        (reading.ink, reading.split)
    }

    #[test]
    fn the_edge_decides_the_polarity() {
        let expected = Bitmap::from_fn(20, 20, tree);
        for (on, off, dark_tree) in [
            (10, 240, true),
            (250, 30, false),
            (100, 130, true),
            (1, 0, false),
            (0, 1, true),
            (255, 254, false),
        ] {
            let t = tones(20, 20, |x, y| (if tree(x, y) { on } else { off }, 255));
            let (ink, split) = read(t, Polarity::Auto);
            assert_eq!(ink, expected, "{on} on {off}");
            let threshold = ((on as u16 + off as u16) / 2) as u8;
            let Split::Brightness { threshold: t, dark_tree: d } = split else { panic!("{split:?}") };
            assert_eq!(d, dark_tree);
            assert!(t.abs_diff(threshold) <= 1, "{t} and {threshold}");
        }
        let t = tones(20, 20, |x, y| (if tree(x, y) { 10 } else { 240 }, 255));
        assert_eq!(read(t, Polarity::LightTree).0.ink(), 400 - expected.ink());
    }

    #[test]
    fn opacity_goes_before_brightness_unless_set_by_hand() {
        // A white tree on transparent black.
        let t = tones(20, 20, |x, y| if tree(x, y) { (255, 255) } else { (0, 0) });
        assert_eq!(read(t, Polarity::Auto), (Bitmap::from_fn(20, 20, tree), Split::Opacity));
        // A black tree on white paper with one transparent corner, set to be dark.
        let t = tones(20, 20, |x, y| (if tree(x, y) { 0 } else { 255 }, if x + y < 3 { 0 } else { 255 }));
        assert_eq!(read(t, Polarity::DarkTree).0, Bitmap::from_fn(20, 20, tree));
    }

    #[test]
    fn several_tones_that_are_too_near_are_refused() {
        let mut t = tones(20, 20, |x, y| (if tree(x, y) { 7 } else { 9 + (x % 3) as u8 }, 255));
        assert_eq!(ink_of(&mut t, Polarity::Auto), Err(LowContrast { darkest: 7, lightest: 11 }));
        let mut even = tones(20, 20, |_, _| (200, 255));
        assert_eq!(ink_of(&mut even, Polarity::Auto).map(|reading| reading.ink.ink()), Ok(0));
    }

    #[test]
    fn otsu_splits_two_heaps_between_them() {
        let mut histogram = [0; 256];
        for i in 0..20 {
            histogram[30 + i] = 5;
            histogram[180 + i] = 50;
        }
        let split = otsu(&histogram).unwrap();
        assert!((49..180).contains(&split), "{split}");
        assert_eq!(otsu(&[1; 256]).map(|t| t.abs_diff(127) < 2), Some(true));
        let mut even = [0; 256];
        even[200] = 7;
        even[210] = 7;
        assert_eq!(otsu(&even), None);
    }
}
