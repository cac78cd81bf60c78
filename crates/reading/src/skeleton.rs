//! The same measures of a grown tree: the truth that readings are judged by.

use crate::reader::trunk::{LEAN_AT_LEAST, LEAN_AT_MOST, LEAN_FROM};
use crate::reader::{APART, EVEN, WIDTH_FROM, WIDTH_TO};
use crate::reading::{Foot, Reading};
use pleach_plant::{Parts, StemKind, Tree, math};
use pleach_silhouette::{Bitmap, Camera, Frame, Rasterizer, View};

/// Height at which trunks are counted, as for pictures.
const LEVEL: f64 = 0.05;
/// Trunks nearer than this part of the height are one to the eye: two pixels of 256.
const TOGETHER: f64 = 0.007;
/// Of several trunks, each is at least this part of the widest.
const THINNEST: f64 = 0.4;
/// A stem that rises by less than this slope, in columns per row, lies on the ground or hangs.
const FLAT: f64 = 2.0;
/// Feet cannot be seen where this many times their width is ink.
const CROWDED: f64 = 2.0;
/// Leaves that add less than this part of the ink cannot be seen.
const FEW_LEAVES: f64 = 0.15;
/// Arms are measured over this part of the height.
const ARM: f64 = 0.06;
/// Ink beside the trunk, its window and its least amount: as for pictures.
const BESIDE: f64 = 0.05;
const WINDOW: f64 = 0.03;
const LEAVES_TRUNK: f64 = 0.004;
/// A fork is hidden where foliage covers more than this part of the disc of [`DISC`] heights around it.
const HIDDEN: f64 = 0.25;
const DISC: f64 = 0.04;
/// … or all ink more than this part: branches before it.
const CROSSED: f64 = 0.75;

/// A point of a stem as it is seen, in pixels: column, rows above the ground, radius.
type Point = [f64; 3];

/// A stem with the points of its axis.
struct Seen {
    parent: Option<u32>,
    points: Vec<Point>,
}

impl Reading {
    /// What a reading of the picture of `parts` of `tree` in `view` and `frame` should be: feet, trunk, lean, bare
    /// height, first fork and leaves, with a confidence of 1; all else is not set.
    ///
    /// The definitions are those of the fields, applied to the stems' axes and radii; the height is that of the
    /// picture, in which the finest twigs are lost. What hides or leaves the trunk is drawn without the trunk. Where
    /// foliage covers more than a quarter of the disc of 4 % of the height around the fork, a person cannot see it:
    /// it is given, but with a confidence of 0. So are feet behind ink of more than twice their width, and leaves
    /// that add less than 15 % of the ink.
    #[must_use]
    pub fn from_skeleton(tree: &Tree, view: &View, frame: &Frame, parts: Parts) -> Self {
        let mut reading = Self::default();
        let (mut rasterizer, mut picture) = (Rasterizer::new(), Bitmap::default());
        let mut bare_picture = Bitmap::default();
        rasterizer.draw(tree, view, frame, parts, &mut picture);
        let Some((_, top, _, _)) = picture.ink_box() else { return reading };
        let height = frame.ground_row - f64::from(top);
        let ink = picture.ink();
        let stems = seen(tree, view, frame);
        let Some((feet, main)) = feet(&stems, height) else { return reading };
        let weight: f64 = feet.iter().map(|foot| foot.width).sum();
        let origin = feet.iter().map(|foot| foot.x * foot.width).sum::<f64>() / weight.max(1e-9);
        let path = path(&stems, main);
        let axis: Vec<Point> = axis(&stems, &path);
        reading.feet = feet
            .iter()
            .map(|foot| Foot { x: (foot.x - origin) / height, width: foot.width / height })
            .collect();
        reading.width_confidence = 1.0;
        // Foliage and branches down to the ground hide them.
        let row = (frame.ground_row - LEVEL * height).max(0.0) as u32;
        let at_level = picture.ink_in_row(row.min(picture.height() - 1)).count() as f64;
        reading.feet_confidence = if at_level > CROWDED * weight + 2.0 { 0.0 } else { 1.0 };
        let mut rest = tree.clone();
        for &stem in &path {
            let knots = rest.stems[stem].knots();
            rest.knots[knots].iter_mut().for_each(|knot| knot.radius = 0.0);
        }
        rasterizer.draw(&rest, view, frame, parts, &mut picture);
        let fork = fork(&stems, &path, height);
        let bare = bare(&picture, frame, &axis, height);
        let bare = fork.as_ref().map_or(bare, |(at, _)| bare.min(at[1] / height));
        (reading.bare_height, reading.bare_height_confidence) = (Some(bare), 1.0);
        let to = bare.clamp(LEAN_AT_LEAST, LEAN_AT_MOST);
        let from = LEAN_FROM.min(to / 3.0);
        reading.lean_deg = slope(&axis, from * height, to * height).map(degrees);
        reading.lean_deg_confidence = f64::from(u8::from(reading.lean_deg.is_some()));
        reading.trunk =
            axis.iter().map(|p| [(p[0] - origin) / height, p[1] / height, 2.0 * p[2] / height]).collect();
        reading.trunk_confidence = 1.0;
        reading.first_fork_confidence = 1.0;
        if let Some((at, slopes)) = fork {
            let mut is_hidden = false;
            let wide = (3.0 * at[2]).max(DISC * height);
            for (parts, radius, limit) in [(foliage_of(parts), DISC * height, HIDDEN), (parts, wide, CROSSED)]
            {
                rasterizer.draw(tree, view, frame, parts, &mut picture);
                is_hidden |= coverage(&picture, frame, at, radius) > limit;
            }
            reading.first_fork = Some(at[1] / height);
            reading.fork_x = Some((at[0] - origin) / height);
            reading.fork_arms_deg = slopes.iter().map(|&slope| degrees(slope)).collect();
            reading.first_fork_confidence = if is_hidden { 0.0 } else { 1.0 };
        }
        let has = |part: Parts, is_there: bool| parts.contains(part) && is_there;
        reading.leaves =
            has(Parts::LEAVES, !tree.leaves.is_empty()) || has(Parts::BLOBS, !tree.blobs.is_empty());
        rasterizer.draw(tree, view, frame, Parts::STEMS, &mut bare_picture);
        let covered = 1.0 - bare_picture.ink() as f64 / ink.max(1) as f64;
        reading.leaves_confidence = if reading.leaves && covered < FEW_LEAVES { 0.0 } else { 1.0 };
        reading
    }
}

fn degrees(slope: f64) -> f64 {
    math::atan2(slope, 1.0).to_degrees()
}

/// Those of `parts` that are foliage; roots, which nothing draws here, where there are none.
fn foliage_of(parts: Parts) -> Parts {
    if parts.contains(Parts::LEAVES) { Parts::FOLIAGE } else { Parts::ROOTS }
}

/// The stems as they are seen.
fn seen(tree: &Tree, view: &View, frame: &Frame) -> Vec<Seen> {
    /// Points per piece of a stem.
    const STEPS: u32 = 8;
    let camera = Camera::new(view, frame);
    let point = |at: glam::DVec3, radius: f64| {
        let magnification = camera.magnification(at).unwrap_or(1.0);
        let (x, y) = camera.project(at, magnification);
        [x, frame.ground_row - y, radius * magnification * camera.pixels_per_meter()]
    };
    let stem = |stem: &pleach_plant::Stem| {
        let is_root = stem.kind == StemKind::Root;
        let mut points = Vec::new();
        for (piece, from, to) in tree.pieces_of(stem).filter(|_| !is_root) {
            let first = u32::from(!points.is_empty());
            points.extend((first..=STEPS).map(|i| {
                let t = f64::from(i) / f64::from(STEPS);
                point(piece.at(t), from + (to - from) * t)
            }));
        }
        Seen { parent: stem.parent, points }
    };
    tree.stems.iter().map(stem).collect()
}

/// Where a stem first rises through `height`, if it does: the point there.
fn crossing(points: &[Point], height: f64) -> Option<Point> {
    let pair = points.windows(2).find(|pair| pair[0][1] <= height && pair[1][1] > height)?;
    let t = (height - pair[0][1]) / (pair[1][1] - pair[0][1]);
    Some(std::array::from_fn(|i| pair[0][i] + (pair[1][i] - pair[0][i]) * t))
}

/// Feet in pixels, and the stem that is the main trunk.
fn feet(stems: &[Seen], height: f64) -> Option<(Vec<Foot>, usize)> {
    let level = LEVEL * height;
    let mut found: Vec<(f64, f64, usize)> = Vec::new();
    for (i, stem) in stems.iter().enumerate() {
        // What comes down from above and rises again is a branch.
        let rises = stem.points.first().is_some_and(|first| first[1] <= level);
        let above = crossing(&stem.points, 1.5 * level);
        let is_steep = |at: &Point| above.is_none_or(|above| (above[0] - at[0]).abs() <= FLAT * 0.5 * level);
        if let Some(at) = crossing(&stem.points, level).filter(|at| rises && is_steep(at)) {
            found.push((at[0], thickness(stems, i, height).unwrap_or(2.0 * at[2]), i));
        }
    }
    let widest = found.iter().map(|foot| foot.1).fold(0.0, f64::max);
    found.retain(|foot| foot.1 >= THINNEST * widest);
    found.sort_by(|a, b| (a.0 - a.1 / 2.0).total_cmp(&(b.0 - b.1 / 2.0)));
    let mut feet: Vec<(f64, f64, f64, usize)> = Vec::new(); // left, right, widest stem, its number
    for (x, width, stem) in found {
        let (left, right) = (x - width / 2.0, x + width / 2.0);
        match feet.last_mut() {
            Some(last) if left - last.1 < TOGETHER * height => {
                last.1 = last.1.max(right);
                if width > last.2 {
                    (last.2, last.3) = (width, stem);
                }
            }
            _ => feet.push((left, right, width, stem)),
        }
    }
    let base = |mut stem: usize| {
        while let Some(parent) = stems[stem].parent {
            stem = parent as usize;
        }
        stems[stem].points.first().map_or(0.0, |point| point[0])
    };
    let widest = feet.iter().map(|foot| foot.1 - foot.0).fold(0.0, f64::max);
    let main = feet.iter().filter(|foot| foot.1 - foot.0 >= 0.9 * widest);
    let middle = feet.iter().map(|foot| base(foot.3)).sum::<f64>() / feet.len() as f64;
    let away = |foot: &&(f64, f64, f64, usize)| (base(foot.3) - middle).abs();
    let main = main.min_by(|a, b| away(a).total_cmp(&away(b)))?.3;
    Some((feet.iter().map(|foot| Foot { x: base(foot.3), width: foot.1 - foot.0 }).collect(), main))
}

/// Mean thickness of a stem and what continues it, between the heights where widths are measured.
fn thickness(stems: &[Seen], stem: usize, height: f64) -> Option<f64> {
    let axis = axis(stems, &path(stems, stem));
    let (mut sum, mut count) = (0.0, 0.0);
    for i in 0..=16 {
        let part = WIDTH_FROM + (WIDTH_TO - WIDTH_FROM) * f64::from(i) / 16.0;
        if let Some(at) = crossing(&axis, part * height) {
            sum += 2.0 * at[2];
            count += 1.0;
        }
    }
    (count > 0.0).then(|| sum / count)
}

/// A stem, its ancestors, and the stems that continue it from its tip.
fn path(stems: &[Seen], stem: usize) -> Vec<usize> {
    let mut path = vec![stem];
    while let Some(parent) = stems[path[0]].parent {
        path.insert(0, parent as usize);
    }
    let mut at = stem;
    while let Some(tip) = stems[at].points.last() {
        let near = |p: &Point| {
            let (dx, dy) = (p[0] - tip[0], p[1] - tip[1]);
            dx * dx + dy * dy <= (0.5 * tip[2] + 1.0) * (0.5 * tip[2] + 1.0)
        };
        let continues = |(i, stem): (usize, &Seen)| {
            let first = stem.points.first()?;
            let is_next = stem.parent == Some(at as u32) && near(first) && first[2] >= 0.5 * tip[2];
            is_next.then_some((i, first[2]))
        };
        let next = stems.iter().enumerate().skip(at + 1).filter_map(continues);
        match next.max_by(|a, b| a.1.total_cmp(&b.1)) {
            Some((next, _)) => at = next,
            None => break,
        }
        path.push(at);
    }
    path
}

/// The points of the stems of a path, each up to where the next one begins.
fn axis(stems: &[Seen], path: &[usize]) -> Vec<Point> {
    let mut axis: Vec<Point> = Vec::new();
    for (place, &stem) in path.iter().enumerate() {
        let end = path.get(place + 1).and_then(|&next| stems[next].points.first());
        let points = stems[stem].points.iter();
        match end {
            Some(end) => axis.extend(points.take_while(|point| point[1] <= end[1])),
            None => axis.extend(points),
        }
    }
    axis
}

/// Slope of the line fitted to the axis between two heights, in pixels.
fn slope(axis: &[Point], from: f64, to: f64) -> Option<f64> {
    let (mut n, mut sx, mut sy, mut sxx, mut sxy) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for i in 0..=32 {
        let Some(at) = crossing(axis, from + (to - from) * f64::from(i) / 32.0) else { continue };
        n += 1.0;
        sx += at[1];
        sy += at[0];
        sxx += at[1] * at[1];
        sxy += at[1] * at[0];
    }
    let spread = n * sxx - sx * sx;
    (spread > 0.0).then(|| (n * sxy - sx * sy) / spread)
}

/// The lowest fork of the path above the height at which trunks are counted: where, and the slopes of its arms.
fn fork(stems: &[Seen], path: &[usize], height: f64) -> Option<(Point, Vec<f64>)> {
    let axis = axis(stems, path);
    let mut lowest: Option<(Point, Vec<f64>)> = None;
    for (i, stem) in stems.iter().enumerate() {
        let (Some(&at), Some(parent)) = (stem.points.first(), stem.parent) else { continue };
        let is_beside = path.contains(&(parent as usize)) && !path.contains(&i);
        if !is_beside || at[1] < LEVEL * height || lowest.as_ref().is_some_and(|(low, _)| low[1] <= at[1]) {
            continue;
        }
        let above = at[1] + ARM * height;
        // The arm, along what continues it, and the trunk above the fork.
        let arm = self::axis(stems, &path_from(stems, i));
        let (Some(arm), Some(trunk)) = (crossing(&arm, above), crossing(&axis, above)) else { continue };
        let Some(here) = crossing(&axis, at[1] + 0.01 * height) else { continue };
        let slopes = [(arm[0] - at[0]) / (above - at[1]), (trunk[0] - here[0]) / (above - here[1])];
        let (thin, thick) = (arm[2].min(trunk[2]), arm[2].max(trunk[2]));
        if thin >= EVEN * thick && (slopes[0] - slopes[1]).abs() >= APART && thin >= 0.0015 * height {
            let mut slopes = slopes.to_vec();
            slopes.sort_by(f64::total_cmp);
            lowest = Some((at, slopes));
        }
    }
    lowest
}

/// A stem and what continues it.
fn path_from(stems: &[Seen], stem: usize) -> Vec<usize> {
    let path = path(stems, stem);
    let from = path.iter().position(|&one| one == stem).unwrap_or(0);
    path[from..].to_vec()
}

/// Height, as a part, up to which none of `rest`, the tree without its trunk, is beside or before the trunk.
fn bare(rest: &Bitmap, frame: &Frame, axis: &[Point], height: f64) -> f64 {
    let first = LEVEL * height;
    let mut window: std::collections::VecDeque<f64> = std::collections::VecDeque::new();
    let rows = (WINDOW * height).round().max(3.0) as usize;
    let least = LEAVES_TRUNK * height * rows as f64;
    let mut up = first.floor();
    while up < height {
        let Some(at) = crossing(axis, up + 0.5) else { return up / height };
        let y = (frame.ground_row - up - 1.0).round();
        let ink = if y < 0.0 {
            0.0
        } else {
            let beside = |x: u32| {
                let away = (f64::from(x) + 0.5 - at[0]).abs() - at[2];
                away <= BESIDE * height
            };
            let outside = |x: u32| (f64::from(x) + 0.5 - at[0]).abs() > at[2];
            rest.ink_in_row(y as u32).filter(|&x| beside(x) && outside(x)).count() as f64
        };
        window.push_back(ink);
        if window.len() > rows {
            window.pop_front();
        }
        if window.iter().sum::<f64>() >= least {
            let lowest = window.iter().position(|&ink| ink > 0.0).unwrap_or(0);
            return (up + 1.0 - (window.len() - lowest) as f64) / height;
        }
        up += 1.0;
    }
    1.0
}

/// Part of the disc around `at` that is ink.
fn coverage(picture: &Bitmap, frame: &Frame, at: Point, radius: f64) -> f64 {
    let (x0, y0) = (at[0], frame.ground_row - at[1]);
    let span = |center: f64| ((center - radius).max(0.0) as u32, (center + radius).max(0.0) as u32);
    let (columns, rows) = (span(x0), span(y0));
    let (mut all, mut ink) = (0_u32, 0_u32);
    for y in rows.0..=rows.1 {
        for x in columns.0..=columns.1 {
            let (dx, dy) = (f64::from(x) + 0.5 - x0, f64::from(y) + 0.5 - y0);
            if dx * dx + dy * dy <= radius * radius {
                all += 1;
                ink += u32::from(picture.get(x, y));
            }
        }
    }
    f64::from(ink) / f64::from(all.max(1))
}
