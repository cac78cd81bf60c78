//! A picture in at most 256 colours, for files a third as large: median cut (Heckbert 1982).

use crate::picture::Picture;

/// Bits per channel of the colours before boxes are cut.
const BITS: u32 = 6;
/// Colours of a picture.
const MAX: usize = 256;

/// Colours and, for each pixel, the number of its own. Opacity is ignored.
pub(crate) struct FewColors {
    pub(crate) colors: Vec<[u8; 3]>,
    pub(crate) pixels: Vec<u8>,
}

/// Pixels that fall into one cell of the colour cube.
#[derive(Clone, Copy, Default)]
struct Cell {
    cell: u32,
    count: u64,
    sum: [u64; 3],
}

impl Cell {
    fn mean(&self, channel: usize) -> u64 {
        self.sum[channel] / self.count.max(1)
    }
}

impl FewColors {
    pub(crate) fn new(picture: &Picture) -> Self {
        let mut cells = cells(picture);
        let mut boxes = Vec::with_capacity(MAX);
        boxes.push(0..cells.len());
        while boxes.len() < MAX {
            // The box with the largest error is cut; of equals the first, so that results are always the same.
            let worst = boxes
                .iter()
                .enumerate()
                .map(|(i, b)| (i, error(&cells[b.clone()])))
                .fold((0, (0, 0)), |best, (i, e)| if e.0 > best.1.0 { (i, e) } else { best });
            let (i, (error, channel)) = worst;
            if error == 0 {
                break;
            }
            let range = boxes[i].clone();
            let inside = &mut cells[range.clone()];
            inside.sort_by_key(|c| (c.mean(channel), c.cell));
            let cut = range.start + middle(inside);
            boxes[i] = range.start..cut;
            boxes.push(cut..range.end);
        }
        let mut number = vec![0_u8; 1 << (3 * BITS)];
        let mut colors = Vec::with_capacity(boxes.len());
        for (i, range) in boxes.into_iter().enumerate() {
            let mut whole = Cell::default();
            for cell in &cells[range] {
                number[cell.cell as usize] = i as u8;
                whole.count += cell.count;
                (0..3).for_each(|c| whole.sum[c] += cell.sum[c]);
            }
            colors.push([0, 1, 2].map(|c| ((whole.sum[c] + whole.count / 2) / whole.count.max(1)) as u8));
        }
        let pixels = picture.rgba.chunks_exact(4).map(|p| number[index(p)]).collect();
        Self { colors, pixels }
    }
}

fn index(pixel: &[u8]) -> usize {
    pixel[..3].iter().fold(0, |i, &c| i << BITS | usize::from(c >> (8 - BITS)))
}

fn cells(picture: &Picture) -> Vec<Cell> {
    let mut cells = vec![Cell::default(); 1 << (3 * BITS)];
    for pixel in picture.rgba.chunks_exact(4) {
        let cell = &mut cells[index(pixel)];
        cell.count += 1;
        (0..3).for_each(|c| cell.sum[c] += u64::from(pixel[c]));
    }
    cells.iter_mut().zip(0..).for_each(|(cell, i)| cell.cell = i);
    cells.retain(|c| c.count > 0);
    cells
}

/// Pixels times the square of the widest range, and the channel of that range; 0 for what cannot be
/// cut.
fn error(cells: &[Cell]) -> (u64, usize) {
    if cells.len() < 2 {
        return (0, 0);
    }
    let pixels: u64 = cells.iter().map(|c| c.count).sum();
    let range = |channel: usize| {
        let (low, high) =
            cells.iter().map(|c| c.mean(channel)).fold((255, 0), |(l, h), m| (m.min(l), m.max(h)));
        high - low
    };
    let widest = (0..3).fold((0, 0), |best, c| if range(c) > best.0 { (range(c), c) } else { best });
    // Flat backgrounds have most of the pixels and need few colours: the root tames them.
    (((pixels as f64).sqrt() * (widest.0 * widest.0) as f64) as u64, widest.1)
}

/// How many of the sorted cells hold half of the pixels, one at least and all but one at most.
fn middle(cells: &[Cell]) -> usize {
    let half = cells.iter().map(|c| c.count).sum::<u64>() / 2;
    let mut seen = 0;
    let below = cells.iter().take_while(|c| {
        seen += c.count;
        seen <= half
    });
    below.count().clamp(1, cells.len() - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(color: impl Fn(u32) -> [u8; 3]) -> Picture {
        let rgba = (0..64 * 64).flat_map(|i| {
            let [r, g, b] = color(i);
            [r, g, b, 255]
        });
        Picture { width: 64, height: 64, rgba: rgba.collect() }
    }

    #[test]
    fn few_colours_stay_as_they_are() {
        let picture = picture(|i| if i % 7 == 0 { [10, 200, 30] } else { [250, 250, 250] });
        let few = FewColors::new(&picture);
        assert_eq!(few.colors.len(), 2);
        for (pixel, number) in picture.rgba.chunks_exact(4).zip(&few.pixels) {
            assert_eq!(few.colors[usize::from(*number)], pixel[..3]);
        }
    }

    #[test]
    fn many_colours_come_out_near() {
        let picture = picture(|i| [i % 64 * 4, i / 64 * 4, (i * 37 % 256) / 8].map(|c| c as u8));
        let few = FewColors::new(&picture);
        assert_eq!(few.colors.len(), MAX);
        let strays = picture.rgba.chunks_exact(4).zip(&few.pixels).map(|(pixel, number)| {
            let near = few.colors[usize::from(*number)];
            (0..3).map(|c| u32::from(pixel[c].abs_diff(near[c])).pow(2)).sum::<u32>()
        });
        let mean = strays.map(f64::from).sum::<f64>() / f64::from(64 * 64);
        assert!(mean.sqrt() < 16.0, "{}", mean.sqrt());
    }
}
