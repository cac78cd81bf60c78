//! A silhouette that is drawn once at high resolution and resampled to many frames.

use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::{Foliage, Tree};
use serde::{Deserialize, Serialize};

/// A silhouette at no less than twice the resolution of the pictures that are made from it.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(into = "Packed", try_from = "Packed")]
pub(crate) struct FineSilhouette {
    picture: Bitmap,
    frame: Frame,
}

/// A fine silhouette as it is serialised: each row as its difference from the one above, which packs smaller.
#[derive(Serialize, Deserialize)]
struct Packed {
    /// Width and height in pixels.
    size: (u32, u32),
    meters_per_pixel: f64,
    /// The trunk's foot: column and row.
    foot: (f64, f64),
    /// Words of 64 pixels, the lowest byte first.
    #[serde(with = "serde_bytes")]
    changes: Vec<u8>,
}

impl From<FineSilhouette> for Packed {
    fn from(FineSilhouette { picture, frame }: FineSilhouette) -> Self {
        let words = picture.words();
        let width = words.len() / picture.height().max(1) as usize;
        let above = std::iter::repeat_n(&0, width).chain(words);
        Self {
            size: (picture.width(), picture.height()),
            meters_per_pixel: frame.meters_per_pixel,
            foot: (frame.axis_column, frame.ground_row),
            changes: words.iter().zip(above).flat_map(|(word, above)| (word ^ above).to_le_bytes()).collect(),
        }
    }
}

impl TryFrom<Packed> for FineSilhouette {
    type Error = &'static str;

    fn try_from(
        Packed { size: (width, height), meters_per_pixel, foot, changes }: Packed,
    ) -> Result<Self, Self::Error> {
        let words_per_row = (width as usize).div_ceil(64);
        let mut words: Vec<u64> =
            changes.as_chunks().0.iter().map(|bytes| u64::from_le_bytes(*bytes)).collect();
        for i in words_per_row..words.len() {
            words[i] ^= words[i - words_per_row];
        }
        let picture =
            Bitmap::from_words(width, height, words).ok_or("a picture has as many words as pixels")?;
        let (axis_column, ground_row) = foot;
        Ok(Self { picture, frame: Frame { width, height, meters_per_pixel, axis_column, ground_row } })
    }
}

/// Minimum of its pixels per pixel of the goal.
const FINENESS: u32 = 2;
/// Smallest and largest side, in pixels. A smaller goal is not compared with larger drawings, although those of known
/// species are kept: thin branches are lost, and a bare acer of 64 pixels passes for a leafy one.
const SIDES: (u32, u32) = (128, 2048);
/// One of this many parts of the side is added below the ground.
const BELOW: u32 = 8;

/// The side of fine silhouettes for goals whose tree has `width` × `height` pixels: goals of about the same size share
/// theirs.
pub(crate) fn side_for(width: u32, height: u32) -> u32 {
    FINENESS.saturating_mul(width.max(height)).clamp(SIDES.0, SIDES.1).next_power_of_two()
}

impl FineSilhouette {
    /// Draws `tree` as seen in `view`, whole, about `side` pixels high and wide.
    pub(crate) fn draw(
        tree: &Tree,
        view: &View,
        foliage: Foliage,
        side: u32,
        rasterizer: &mut Rasterizer,
    ) -> Self {
        let frame = Frame::automatic(tree, view, foliage.into(), side, side);
        let frame = Frame { height: side + side / BELOW, ..frame };
        let mut picture = Bitmap::default();
        rasterizer.draw(tree, view, &frame, foliage.into(), &mut picture);
        Self { picture, frame }
    }

    /// Resamples the tree, `factor` times as large, to `frame`: a pixel is ink if at least half of its area is.
    pub(crate) fn through(&self, frame: &Frame, factor: f64, into: &mut Bitmap) {
        into.reset(frame.width, frame.height);
        let ratio = frame.meters_per_pixel / (self.frame.meters_per_pixel * factor);
        let (width, height) = (self.picture.width(), self.picture.height());
        let columns = edges(frame.width, frame.axis_column, self.frame.axis_column, ratio, width);
        let rows = edges(frame.height, frame.ground_row, self.frame.ground_row, ratio, height);
        let mut inked = vec![0_u32; columns.len()];
        for (y, &(top, bottom)) in rows.iter().enumerate() {
            inked.fill(0);
            for row in top..bottom {
                let words = self.picture.row(row);
                if words.iter().all(|&word| word == 0) {
                    continue;
                }
                for (sum, &(left, right)) in inked.iter_mut().zip(&columns) {
                    *sum += count(words, left, right);
                }
            }
            for (x, (&sum, &(left, right))) in inked.iter().zip(&columns).enumerate() {
                if sum > 0 && 2 * sum >= (right - left) * (bottom - top) {
                    into.set(x as u32, y as u32, true);
                }
            }
        }
    }
}

/// The first and the end of the fine pixels under each of `count` pixels, within the fine picture.
fn edges(count: u32, origin: f64, plate_origin: f64, ratio: f64, limit: u32) -> Vec<(u32, u32)> {
    let edge = |i: u32| plate_origin + (f64::from(i) - origin) * ratio;
    let within = |at: f64| at.clamp(0.0, f64::from(limit)) as u32;
    (0..count)
        .map(|i| {
            let (from, to) = (edge(i).round(), edge(i + 1).round());
            // Where the fine picture is the coarser one: the pixel under the middle.
            let (from, to) = if from < to {
                (from, to)
            } else {
                let middle = edge(i).midpoint(edge(i + 1)).floor();
                (middle, middle + 1.0)
            };
            (within(from), within(to))
        })
        .collect()
}

/// Inked pixels of a row from `left` to before `right`.
fn count(words: &[u64], left: u32, right: u32) -> u32 {
    if left >= right {
        return 0;
    }
    let (first, last) = (left as usize / 64, (right as usize - 1) / 64);
    let from = u64::MAX << (left % 64);
    let to = u64::MAX >> (63 - (right - 1) % 64);
    if first == last {
        return (words[first] & from & to).count_ones();
    }
    let inner: u32 = words[first + 1..last].iter().map(|word| word.count_ones()).sum();
    (words[first] & from).count_ones() + inner + (words[last] & to).count_ones()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_counted_across_words() {
        let row = Bitmap::from_fn(200, 1, |x, _| x % 3 == 0);
        for (left, right) in [(0, 200), (5, 5), (63, 65), (64, 128), (10, 190), (127, 129), (199, 200)] {
            let expected = (left..right).filter(|x| x % 3 == 0).count() as u32;
            assert_eq!(count(row.row(0), left, right), expected, "{left}..{right}");
        }
    }

    #[test]
    fn a_plate_is_seen_as_the_world_is() {
        // A square metre on the ground, one metre right of the axis, at one centimetre per pixel.
        let fine = FineSilhouette {
            picture: Bitmap::from_fn(400, 220, |x, y| (300..400).contains(&x) && (100..200).contains(&y)),
            frame: Frame {
                width: 400,
                height: 220,
                meters_per_pixel: 0.01,
                axis_column: 200.0,
                ground_row: 200.0,
            },
        };
        let mut seen = Bitmap::default();
        let frame =
            Frame { width: 64, height: 64, meters_per_pixel: 0.1, axis_column: 20.0, ground_row: 60.0 };
        fine.through(&frame, 1.0, &mut seen);
        assert_eq!((seen.ink_box(), seen.ink()), (Some((30, 50, 39, 59)), 100));
        fine.through(&frame, 2.0, &mut seen);
        assert_eq!((seen.ink_box(), seen.ink()), (Some((40, 40, 59, 59)), 400));
        // Finer than the fine picture: every pixel of it four by four times.
        let near =
            Frame { width: 64, height: 64, meters_per_pixel: 0.0025, axis_column: -400.0, ground_row: 64.0 };
        fine.through(&near, 1.0, &mut seen);
        assert_eq!(seen.ink(), 64 * 64);
    }

    #[test]
    fn goals_of_about_one_size_share_plates() {
        assert_eq!((side_for(256, 200), side_for(180, 256), side_for(64, 64)), (512, 512, 128));
        assert_eq!((side_for(16, 16), side_for(2048, 9)), (128, 2048));
    }

    #[test]
    fn a_plate_is_read_as_it_was_written() {
        let frame =
            Frame { width: 70, height: 40, meters_per_pixel: 0.1, axis_column: 35.3, ground_row: 39.0 };
        let fine = FineSilhouette { picture: Bitmap::from_fn(70, 40, |x, y| (x * y) % 5 == 0), frame };
        let bytes = postcard::to_stdvec(&fine).unwrap();
        let read: FineSilhouette = postcard::from_bytes(&bytes).unwrap();
        assert_eq!((read.picture, read.frame), (fine.picture, fine.frame));
        // A byte of the picture is missing.
        let mut packed = Packed::from(FineSilhouette { picture: Bitmap::new(64, 2), frame });
        let _ = packed.changes.pop();
        assert!(FineSilhouette::try_from(packed).is_err());
    }
}
