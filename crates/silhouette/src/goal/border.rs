//! What lies around a picture and is not of it: printed frames, edges of a scanner's bed, bars above and
//! below.
//!
//! A frame is a band along an edge of one tone, behind which many pixels have another tone at once, those near
//! the corners included: a tree may lie against the frame. The paper of a silhouette is of one tone as well,
//! but goes on beside the tip of a tree.
//!
//! What is not of the picture gets the values of the nearest pixels that are, so that thresholds and
//! backgrounds are found as if nothing were there, and is paper in the end.

use crate::bitmap::Bitmap;

/// A frame is at most this part of the picture's width or height on each side.
const WIDEST: f64 = 0.15;
/// Lines are looked at over this part of their length: their ends may belong to the next side's band.
const MIDDLE: f64 = 0.7;
/// Pixels of a band have a tone within this many levels of 255 of the median ...
const LIKE: u8 = 20;
/// ... in at least this part of each line.
const EVEN: f64 = 0.97;
/// What is behind a band differs from it by more than this ...
const UNLIKE: u8 = 40;
/// ... in at least this part of a line ...
const BEHIND: f64 = 0.25;
/// ... and in at least this part of either end of it, a twentieth of its length.
const ENDS: f64 = 0.9;
const END: usize = 20;
/// Lines of mixed tones between a band and what is behind it.
const SOFT: u32 = 2;
/// Bands within bands, such as white paper around a black line.
const ROUNDS: usize = 4;
/// A picture has at least this range of tones; what is left when a frame is gone must have it, too.
const RANGE: u8 = 40;

/// How many rows and columns are frame, from each edge of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameWidths {
    /// Columns from the left edge.
    pub left: u32,
    /// Rows from the top edge.
    pub top: u32,
    /// Columns from the right edge.
    pub right: u32,
    /// Rows from the bottom edge.
    pub bottom: u32,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Left,
    Top,
    Right,
    Bottom,
}

/// The frame around a picture of these brightnesses, row by row; `None` if there is no frame.
///
/// A lone band at the bottom is the ground that a tree stands on, and stays.
pub(crate) fn frame(light: &[u8], width: u32, height: u32) -> Option<FrameWidths> {
    let picture = Lines { light, width, height };
    let mut found = FrameWidths::default();
    for _ in 0..ROUNDS {
        let bands = [Side::Left, Side::Top, Side::Right, Side::Bottom]
            .map(|side| picture.band(side, found).map(|(lines, tone)| (side, lines, tone)));
        let bands: Vec<_> = bands.into_iter().flatten().collect();
        let is_frame = |&&(side, _, tone): &&(Side, u32, u8)| {
            side != Side::Bottom || bands.iter().any(|b| b.0 != side && b.2.abs_diff(tone) <= UNLIKE)
        };
        let mut wider = found;
        for &(side, lines, _) in bands.iter().filter(is_frame) {
            *wider.side_mut(side) += lines;
        }
        if wider == found {
            break;
        }
        found = wider;
    }
    (found != FrameWidths::default() && picture.range(found) >= RANGE).then_some(found)
}

impl FrameWidths {
    fn side_mut(&mut self, side: Side) -> &mut u32 {
        match side {
            Side::Left => &mut self.left,
            Side::Top => &mut self.top,
            Side::Right => &mut self.right,
            Side::Bottom => &mut self.bottom,
        }
    }

    /// The pixels that are not frame.
    pub(crate) fn inside(self, width: u32, height: u32) -> Bitmap {
        let (right, bottom) = (width.saturating_sub(self.right), height.saturating_sub(self.bottom));
        Bitmap::from_fn(width, height, |x, y| x >= self.left && x < right && y >= self.top && y < bottom)
    }

    /// Each side that has a frame, in words.
    pub(super) fn sides(self) -> String {
        let sides = [("left", self.left), ("top", self.top), ("right", self.right), ("bottom", self.bottom)];
        let sides = sides.iter().filter(|(_, lines)| *lines > 0);
        sides.map(|(name, lines)| format!("{name} {lines}")).collect::<Vec<_>>().join(", ")
    }
}

struct Lines<'a> {
    light: &'a [u8],
    width: u32,
    height: u32,
}

impl Lines<'_> {
    /// The middle of the line that is `depth` pixels behind what is already known to be frame.
    fn line(&self, side: Side, frame: FrameWidths, depth: u32) -> Vec<u8> {
        let (across, before, after) = match side {
            Side::Left | Side::Right => (self.height, frame.top, frame.bottom),
            Side::Top | Side::Bottom => (self.width, frame.left, frame.right),
        };
        let length = across.saturating_sub(before + after);
        let skipped = (f64::from(length) * (1.0 - MIDDLE) / 2.0) as u32;
        let at = |along: u32| {
            let (x, y) = match side {
                Side::Left => (frame.left + depth, along),
                Side::Right => (self.width - 1 - frame.right - depth, along),
                Side::Top => (along, frame.top + depth),
                Side::Bottom => (along, self.height - 1 - frame.bottom - depth),
            };
            self.light[y as usize * self.width as usize + x as usize]
        };
        (before + skipped..before + length.saturating_sub(skipped)).map(at).collect()
    }

    /// Lines of a band, those of mixed tones behind it included, and its tone.
    fn band(&self, side: Side, frame: FrameWidths) -> Option<(u32, u8)> {
        let (across, known) = match side {
            Side::Left => (self.width, frame.left),
            Side::Right => (self.width, frame.right),
            Side::Top => (self.height, frame.top),
            Side::Bottom => (self.height, frame.bottom),
        };
        let most = ((WIDEST * f64::from(across)) as u32).checked_sub(known)?;
        let mut outermost = self.line(side, frame, 0);
        let middle = outermost.len() / 2;
        if outermost.is_empty() {
            return None;
        }
        let tone = *outermost.select_nth_unstable(middle).1;
        let part = |line: &[u8], is: fn(u8) -> bool| {
            line.iter().filter(|v| is(v.abs_diff(tone))).count() as f64 / line.len().max(1) as f64
        };
        let is_even = |&depth: &u32| part(&self.line(side, frame, depth), |off| off <= LIKE) >= EVEN;
        let lines = (0..=most).take_while(is_even).count() as u32;
        if lines == 0 || lines > most {
            return None;
        }
        let is_behind = |&depth: &u32| {
            let line = self.line(side, frame, depth);
            let end = line.len().div_ceil(END);
            let ends = [&line[..end], &line[line.len() - end..]];
            part(&line, |off| off > UNLIKE) >= BEHIND
                && ends.iter().all(|end| part(end, |off| off > UNLIKE) >= ENDS)
        };
        let behind = (lines..=lines + SOFT).find(is_behind)?;
        Some((behind, tone))
    }

    /// The greatest difference of tones within the frame.
    fn range(&self, frame: FrameWidths) -> u8 {
        let rows = frame.top..self.height.saturating_sub(frame.bottom);
        let columns = frame.left as usize..self.width.saturating_sub(frame.right) as usize;
        let row = |y: u32| &self.light[y as usize * self.width as usize..][columns.clone()];
        let (least, most) =
            rows.flat_map(row).fold((255_u8, 0_u8), |(least, most), &v| (least.min(v), most.max(v)));
        most.saturating_sub(least)
    }
}

/// Gives each pixel outside of `inside` the value of the nearest one inside: of its row, or of the nearest
/// row that has one.
pub(crate) fn extend<T: Copy>(pixels: &mut [T], inside: &Bitmap) {
    let width = inside.width() as usize;
    let mut known: Vec<u32> = Vec::new();
    for y in 0..inside.height() {
        let columns: Vec<usize> = inside.ink_in_row(y).map(|x| x as usize).collect();
        if columns.is_empty() {
            continue;
        }
        known.push(y);
        let row = &mut pixels[y as usize * width..][..width];
        let mut next = 0;
        for x in 0..width {
            while next + 1 < columns.len() && columns[next + 1].abs_diff(x) <= columns[next].abs_diff(x) {
                next += 1;
            }
            row[x] = row[columns[next]];
        }
    }
    if known.is_empty() {
        return;
    }
    let mut next = 0;
    for y in 0..inside.height() {
        while next + 1 < known.len() && known[next + 1].abs_diff(y) <= known[next].abs_diff(y) {
            next += 1;
        }
        let from = known[next] as usize * width;
        if known[next] != y {
            pixels.copy_within(from..from + width, y as usize * width);
        }
    }
}

/// The ink that lies inside.
pub(crate) fn within(ink: &Bitmap, inside: &Bitmap) -> Bitmap {
    Bitmap::from_fn(ink.width(), ink.height(), |x, y| ink.get(x, y) && inside.get(x, y))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIDE: u32 = 100;

    fn tree(x: u32, y: u32) -> bool {
        (48..52).contains(&x) && y > 20 && y < 90 || x.abs_diff(50) + y.abs_diff(40) < 20
    }

    fn light(at: impl Fn(u32, u32) -> u8) -> Vec<u8> {
        (0..SIDE * SIDE).map(|i| at(i % SIDE, i / SIDE)).collect()
    }

    fn found(at: impl Fn(u32, u32) -> u8) -> Option<[u32; 4]> {
        frame(&light(at), SIDE, SIDE).map(|f| [f.left, f.top, f.right, f.bottom])
    }

    fn paper(x: u32, y: u32) -> u8 {
        if tree(x, y) { 0 } else { 255 }
    }

    #[test]
    fn bands_are_measured_on_one_to_four_sides() {
        for wide in [1, 2, 5, 12] {
            let all = |x: u32, y: u32| {
                let inner = wide..SIDE - wide;
                if inner.contains(&x) && inner.contains(&y) { paper(x, y) } else { 30 }
            };
            assert_eq!(found(all), Some([wide; 4]), "{wide}");
            assert_eq!(found(|x, y| if x < wide { 30 } else { paper(x, y) }), Some([wide, 0, 0, 0]));
            assert_eq!(found(|x, y| if y < wide { 30 } else { paper(x, y) }), Some([0, wide, 0, 0]));
            let bars = |x, y| if y < wide || y >= SIDE - wide { 30 } else { paper(x, y) };
            assert_eq!(found(bars), Some([0, wide, 0, wide]));
        }
        // A line that is drawn within the margin.
        let inset = |x: u32, y: u32| {
            let edge = x.min(y).min(SIDE - 1 - x).min(SIDE - 1 - y);
            if (4..6).contains(&edge) { 0 } else { paper(x, y) }
        };
        assert_eq!(found(inset), Some([6; 4]));
    }

    #[test]
    fn paper_ground_and_solid_shapes_are_no_frames() {
        assert_eq!(found(paper), None);
        assert_eq!(found(|x, y| if y >= 92 { 0 } else { paper(x, y) }), None);
        let square = |x: u32, y: u32| {
            if (8..92).contains(&x) && (8..92).contains(&y) { 0 } else { 255 }
        };
        assert_eq!(found(square), None);
        assert_eq!(found(|x, y| ((x * 37 + y * 91) % 251) as u8), None);
    }

    #[test]
    fn what_is_outside_gets_the_nearest_value() {
        let inside = Bitmap::from_ascii("....\n.##.\n..#.\n....\n....");
        let mut pixels = b"aaaaabcaaaxaaaaaaaaa".to_vec();
        extend(&mut pixels, &inside);
        assert_eq!(pixels, b"bbccbbccxxxxxxxxxxxx");
    }
}
