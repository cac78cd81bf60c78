//! From a silhouette to a reading.

mod crown;
mod feet;
mod fork;
mod grain;
mod grid;
mod strokes;
mod trace;
pub(crate) mod trunk;

pub(crate) use feet::{WIDTH_FROM, WIDTH_TO};
pub(crate) use fork::{APART, EVEN};
pub(crate) use strokes::Strokes;

use crate::confidence::Evidence;
use crate::error::ReadingError;
use crate::reading::{Foot, Reading};
use feet::Base;
use grid::Grid;
use pleach_plant::math;
use pleach_silhouette::Bitmap;
use trace::{Rows, Sample, visible};

/// Rows at the top with less than this part of all ink together are specks.
const SPECKS: f64 = 0.0002;
/// Longest side of a picture that is read as it is; larger ones are reduced first.
const MAX_SIDE: u32 = 2000;
/// Trees of at least this many rows have holes of two rows in their trunks closed.
const CLOSED_FROM: usize = 100;
/// Points of a trunk's axis.
const AXIS_POINTS: usize = 24;

/// Reads pictures; keeps its memory from one to the next, and allocates nothing once that has grown to the pictures'
/// size. Only pictures with a side above 2000 pixels are reduced in new memory.
///
/// ```
/// use pleach_reading::{Reader, Reading};
/// use pleach_silhouette::Bitmap;
///
/// let (mut reader, mut reading) = (Reader::new(), Reading::default());
/// for width in [6, 8, 10] {
///     let pole = Bitmap::from_fn(100, 200, |x, _| (50..50 + width).contains(&x));
///     reader.read(&pole, &mut reading);
///     assert!((reading.feet[0].width - f64::from(width) / 200.0).abs() < 1e-9);
/// }
/// ```
#[derive(Clone, Debug, Default)]
pub struct Reader {
    ink: Grid,
    wood: Grid,
    /// Wood, or else ink, with small holes closed: where trunks are followed.
    solid: Grid,
    closed: Grid,
    spare: [Grid; 3],
    samples: Vec<Sample>,
    arms: Vec<Sample>,
    feet: Vec<feet::Foot>,
    pieces: crown::Pieces,
    cells: grain::Cells,
    evidence: Evidence,
}

/// Columns and rows as heights of the tree.
#[derive(Clone, Copy)]
struct Scale {
    rows: f64,
    origin: f64,
}

impl Scale {
    fn x(self, column: f64) -> f64 {
        (column - self.origin) / self.rows
    }
}

impl Reader {
    /// A reader without memory yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// What the confidences of the last reading were made from.
    #[must_use]
    pub const fn evidence(&self) -> &Evidence {
        &self.evidence
    }

    /// Reads `silhouette` into `reading`.
    pub fn read(&mut self, silhouette: &Bitmap, reading: &mut Reading) {
        self.read_both(silhouette, None, reading);
    }

    /// Reads `silhouette`, of which `wood` is the part that is trunk and branches, into `reading`. Feet, trunk, lean
    /// and forks are read from the wood, all else from the silhouette.
    ///
    /// # Errors
    /// [`ReadingError::WoodSize`] if the two differ in size.
    pub fn read_with_wood(
        &mut self,
        silhouette: &Bitmap,
        wood: &Bitmap,
        reading: &mut Reading,
    ) -> Result<(), ReadingError> {
        let size = |picture: &Bitmap| (picture.width(), picture.height());
        if size(silhouette) != size(wood) {
            return Err(ReadingError::WoodSize { wood: size(wood), silhouette: size(silhouette) });
        }
        self.read_both(silhouette, Some(wood), reading);
        Ok(())
    }

    fn read_both(&mut self, silhouette: &Bitmap, wood: Option<&Bitmap>, reading: &mut Reading) {
        let longest = silhouette.width().max(silhouette.height());
        if longest > MAX_SIDE {
            let factor = longest.div_ceil(MAX_SIDE);
            let wood = wood.map(|wood| reduced(wood, factor));
            self.read_small(&reduced(silhouette, factor), wood.as_ref(), reading);
            reading.leaf_size_px = reading.leaf_size_px.map(|size| size * f64::from(factor));
        } else {
            self.read_small(silhouette, wood, reading);
        }
    }

    fn read_small(&mut self, silhouette: &Bitmap, wood: Option<&Bitmap>, reading: &mut Reading) {
        clear(reading);
        self.evidence = Evidence::default();
        let Some((left, top, right, bottom)) = tree_box(silhouette) else { return };
        let count = (bottom + 1 - top) as usize;
        let width = (right + 1 - left) as usize;
        let mut rows = Rows { ground: 0, count };
        let side = crown::closing(rows);
        rows.ground = 1 + count;
        let all = count + 2 + side as usize;
        self.ink.reset(width, all);
        self.ink.crop(silhouette, left, top, bottom + 1, 1);
        self.wood.reset(width, all);
        let has_wood = wood.is_some_and(|wood| {
            self.wood.crop(wood, left, top, bottom + 1, 1);
            self.wood.ink_of_rows(0..all) > 0
        });
        self.solid.copy_from(if has_wood { &self.wood } else { &self.ink });
        if count >= CLOSED_FROM {
            self.solid.close_columns(3, &mut self.spare[0]);
        }
        let base = feet::feet(&self.solid, rows, &mut self.samples, &mut self.feet);
        let weight: f64 = self.feet.iter().map(|foot| foot.width).sum();
        let moment: f64 = self.feet.iter().map(|foot| foot.center * foot.width).sum();
        let origin = if weight > 0.0 { moment / weight } else { width as f64 / 2.0 };
        let scale = Scale { rows: count as f64, origin };
        reading.feet.extend(
            self.feet.iter().map(|foot| Foot { x: scale.x(foot.center), width: foot.width / scale.rows }),
        );
        let bare = self.read_trunk(rows, scale, base, reading);
        self.read_crown(rows, scale, bare, reading);
        if let Some(grain) = grain::grain(&self.ink, &mut self.cells, rows, bare, (width, origin)) {
            (reading.grain_upright, reading.grain_rising) = (Some(grain.upright), Some(grain.rising));
        }
        let touches = (left == 0) as u8 + (right + 1 == silhouette.width()) as u8 + (top == 0) as u8;
        self.evidence.cut_sides = f64::from(touches);
        self.evidence.height = count as f64;
        self.evidence.judge(reading);
    }

    /// Reads what is known of the main trunk; the height in rows up to which it is bare.
    fn read_trunk(&mut self, rows: Rows, scale: Scale, base: Base, reading: &mut Reading) -> usize {
        let widest = self.feet.iter().map(|foot| foot.width).fold(0.0, f64::max);
        let is_main = |foot: &&feet::Foot| foot.width >= 0.9 * widest;
        let away = |foot: &feet::Foot| (foot.center - scale.origin).abs();
        let Some(main) = self.feet.iter().filter(is_main).min_by(|a, b| away(a).total_cmp(&away(b))).copied()
        else {
            return 0;
        };
        let apart =
            self.feet.iter().map(|foot| (foot.center - main.center).abs()).filter(|&apart| apart > 0.0);
        let room = apart.fold(f64::INFINITY, f64::min) / 2.0 - main.width / 2.0;
        trace::trace(&self.solid, rows, main.height, main.run, rows.count, &mut self.samples);
        let seen = visible(&self.samples);
        let bare = trunk::bare_rows(&self.ink, rows, &self.samples, room.max(1.0));
        let fork = fork::first(&self.solid, rows, &self.samples, &mut self.arms);
        let bare = fork.map_or(bare, |fork| bare.min(fork.height.ceil() as usize));
        reading.bare_height = Some(bare as f64 / scale.rows);
        let slope = trunk::slope(rows, &self.samples, bare);
        let degrees = |slope: f64| math::atan2(slope, 1.0).to_degrees();
        reading.lean_deg = slope.map(|(slope, _)| degrees(slope));
        if let Some(fork) = fork {
            reading.first_fork = Some(fork.height / scale.rows);
            reading.fork_x = Some(scale.x(fork.center));
            reading.fork_arms_deg.extend(fork.slopes.map(degrees));
        }
        let point = |sample: &Sample| {
            [scale.x(sample.center), (sample.height as f64 + 0.5) / scale.rows, sample.width / scale.rows]
        };
        reading.trunk.push([scale.x(main.center), 0.0, main.width / scale.rows]);
        let step = seen.div_ceil(AXIS_POINTS).max(1);
        reading.trunk.extend(self.samples[..seen].iter().skip(step / 2).step_by(step).map(point));
        let evidence = &mut self.evidence;
        evidence.feet = self.feet.len() as f64;
        evidence.level = base.level.map_or(5.0, |level| level as f64);
        evidence.agreement = base.agreement;
        evidence.unsteady = main.unsteady;
        evidence.most_unsteady = self.feet.iter().map(|foot| foot.unsteady).fold(0.0, f64::max);
        evidence.width_px = main.width;
        evidence.lean_rows = slope.map_or(0.0, |(_, count)| count as f64 / scale.rows);
        evidence.trunk_rows = seen as f64 / scale.rows;
        let both = self.samples[..seen].iter().filter(|sample| sample.edges == 2).count();
        evidence.trunk_seen = both as f64 / (seen as f64).max(1.0);
        evidence.bare = bare as f64 / scale.rows;
        evidence.fork_seen = fork.map_or(0.0, |fork| fork.seen);
        evidence.fork = fork.map_or(-1.0, |fork| fork.height / scale.rows);
        bare
    }

    fn read_crown(&mut self, rows: Rows, scale: Scale, bare: usize, reading: &mut Reading) {
        let bare = bare.min(rows.count.saturating_sub(1));
        let [first, second, third] = &mut self.spare;
        self.closed.copy_from(&self.ink);
        self.closed.close(crown::closing(rows), first);
        self.closed.fill_holes(first);
        crown::outline(&self.closed, rows, scale.origin, reading);
        let (widest, width, asymmetry) = crown::shape(&self.closed, rows, bare, scale.origin);
        reading.crown_widest = Some((widest / scale.rows).min(1.0));
        reading.crown_width = Some(width / scale.rows);
        reading.asymmetry = Some(asymmetry);
        crown::gaps(&self.ink, &mut self.closed, [&mut *first, &mut *second], rows, bare, reading);
        second.copy_from(&self.ink);
        reading.clumps = crown::clumps(second, first, rows, bare, &mut self.pieces);
        let spare = strokes::Spare { fine: first, line: second, other: third };
        let found = strokes::strokes(&self.ink, spare, rows, bare, scale.origin, self.evidence.width_px);
        self.evidence.strokes = found;
        self.evidence.gap_share = reading.gap_share.unwrap_or(0.0);
        if found.fine > 0.0 {
            reading.twig_fineness = Some(found.width / scale.rows);
            reading.leaf_size_px = Some(2.0 * found.width);
        }
        if found.lines > 0.0 {
            reading.stroke_deg = Some(found.elevation);
            reading.stroke_upright = Some(found.upright);
        }
        reading.hanging_ends = (found.ends > 0.0).then_some(found.hanging);
    }
}

impl Reading {
    /// What is in `silhouette`.
    ///
    /// ```
    /// use pleach_reading::Reading;
    /// use pleach_silhouette::Bitmap;
    ///
    /// let nothing = Reading::from_silhouette(&Bitmap::new(64, 64));
    /// assert!(nothing.feet.is_empty() && nothing.feet_confidence == 0.0);
    /// ```
    #[must_use]
    pub fn from_silhouette(silhouette: &Bitmap) -> Self {
        let mut reading = Self::default();
        Reader::new().read(silhouette, &mut reading);
        reading
    }

    /// What is in `silhouette`, of which `wood` is the part that is trunk and branches: see
    /// [`Reader::read_with_wood`].
    ///
    /// # Errors
    /// [`ReadingError::WoodSize`] if the two differ in size.
    pub fn from_silhouette_with_wood(silhouette: &Bitmap, wood: &Bitmap) -> Result<Self, ReadingError> {
        let mut reading = Self::default();
        Reader::new().read_with_wood(silhouette, wood, &mut reading)?;
        Ok(reading)
    }
}

/// Makes a reading one of nothing, and keeps its memory.
fn clear(reading: &mut Reading) {
    let mut empty = Reading::default();
    let keep = |from: &mut Vec<f64>, to: &mut Vec<f64>| {
        from.clear();
        std::mem::swap(from, to);
    };
    keep(&mut reading.crown.left, &mut empty.crown.left);
    keep(&mut reading.crown.right, &mut empty.crown.right);
    keep(&mut reading.gap_by_height, &mut empty.gap_by_height);
    keep(&mut reading.gap_sizes, &mut empty.gap_sizes);
    keep(&mut reading.fork_arms_deg, &mut empty.fork_arms_deg);
    reading.feet.clear();
    reading.trunk.clear();
    std::mem::swap(&mut reading.feet, &mut empty.feet);
    std::mem::swap(&mut reading.trunk, &mut empty.trunk);
    *reading = empty;
}

/// First and last column and row of the tree: of all ink, but for specks above it.
fn tree_box(picture: &Bitmap) -> Option<(u32, u32, u32, u32)> {
    let ink = |y: u32| picture.row(y).iter().map(|word| u64::from(word.count_ones())).sum::<u64>();
    let least = (SPECKS * picture.ink() as f64) as u64;
    let mut above = 0;
    let top = (0..picture.height()).find(|&y| {
        above += ink(y);
        above > least
    })?;
    let bottom = (top..picture.height()).rev().find(|&y| ink(y) > 0)?;
    let (mut left, mut right) = (u32::MAX, 0);
    for y in top..=bottom {
        let row = picture.row(y);
        let Some(first) = row.iter().position(|&word| word != 0) else { continue };
        let last = row.iter().rposition(|&word| word != 0).unwrap_or(first);
        left = left.min(first as u32 * 64 + row[first].trailing_zeros());
        right = right.max(last as u32 * 64 + 63 - row[last].leading_zeros());
    }
    Some((left, top, right, bottom))
}

/// The picture at a `factor`-th of its size: ink where at least half of a square is.
fn reduced(picture: &Bitmap, factor: u32) -> Bitmap {
    Bitmap::from_fn(picture.width().div_ceil(factor), picture.height().div_ceil(factor), |x, y| {
        let pixels =
            (0..factor * factor).filter(|i| picture.get(x * factor + i % factor, y * factor + i / factor));
        2 * pixels.count() as u32 >= factor * factor
    })
}
