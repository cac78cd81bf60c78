//! The colours of a layer: typical, in the sun, in the shade, and how much they differ.

use super::grid::{Cell, Grid};
use super::oklab::{self, Oklab};
use super::statistics::{quantile, ramp};

/// Colours of one layer in Oklab.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tones {
    pub(super) typical: Oklab,
    pub(super) sunlit: Oklab,
    pub(super) shaded: Oklab,
    /// Mean distance from the typical colour.
    pub(super) spread: f64,
    pub(super) count: usize,
    /// Mean difference in lightness of cells side by side, per mean distance from the typical lightness.
    pub(super) roughness: f64,
}

/// How much more green or red, and more yellow, a leaf is than sunlit leaves are shown: sunlight is warm, and cameras
/// and the renderer take saturation from what is bright. Fitted to renders of the even ones of the seeds from 0 to 7.
const SATURATION: [f32; 2] = [1.22, 1.02];
/// Hues nearer than this to the background's cannot be told from it.
const APART: f32 = 0.04;
/// Flat colours have sunlit leaves lighter than usual ones by at most this.
const FLAT: f64 = 0.01;
/// Crowns up to this roughness are smooth, and from the second on all leaves: stylised ones have 0.02 to 0.1,
/// renders of leaves 0.5 to 1.2.
const SMOOTH: f64 = 0.15;
const ROUGH: f64 = 0.45;

impl Tones {
    /// The colour of leaves themselves.
    ///
    /// The light of a photograph is unknown. Of leaves that can be told apart, those in the sun are assumed to be
    /// shown as light as they are; of a smooth crown, as an icon's or a stylised tree's, what is typical.
    pub(super) fn albedo(&self) -> Oklab {
        let [lightness, a, b] = self.sunlit;
        let rough = [lightness, a * SATURATION[0], b * SATURATION[1]];
        let lit = f64::from(lightness - self.typical[0]);
        let share = (ramp(SMOOTH, ROUGH, self.roughness) * ramp(FLAT, 3.0 * FLAT, lit)) as f32;
        std::array::from_fn(|i| self.typical[i] + share * (rough[i] - self.typical[i]))
    }

    /// `None` of no cells. Cells at the edge count only where there are hardly others.
    pub(super) fn new(grid: &Grid, cells: impl Iterator<Item = usize>) -> Option<Self> {
        let cells = cells.filter(|&at| !oklab::is_black(grid.colors[at]));
        let (mut inner, edge): (Vec<usize>, Vec<usize>) =
            cells.partition(|&at| grid.cells[at] == Cell::Inside);
        if inner.len() < edge.len() / 8 {
            inner.extend(&edge);
        }
        drop_mixed(grid, &mut inner);
        let all = inner;
        let mut light: Vec<f32> = all.iter().map(|&at| grid.colors[at][0]).collect();
        let bounds = [0.0, 0.3, 0.65, 0.97].map(|share| quantile(&mut light, share));
        let [Some(least), Some(low), Some(high), Some(most)] = bounds else { return None };
        let median = |from: f32, to: f32| -> Option<Oklab> {
            let chosen: Vec<Oklab> =
                all.iter().map(|&at| grid.colors[at]).filter(|c| (from..=to).contains(&c[0])).collect();
            let middle = |axis: usize| {
                let mut values: Vec<f32> = chosen.iter().map(|color| color[axis]).collect();
                quantile(&mut values, 0.5)
            };
            Some([middle(0)?, middle(1)?, middle(2)?])
        };
        let typical = median(least, f32::INFINITY)?;
        let mut spread = 0.0;
        for &at in &all {
            let square: f32 =
                (0..3).map(|i| (grid.colors[at][i] - typical[i]) * (grid.colors[at][i] - typical[i])).sum();
            spread += f64::from(square.sqrt());
        }
        let (mut steps, mut away, mut pairs) = (0.0_f64, 0.0_f64, 0_usize);
        for &at in &all {
            away += f64::from((grid.colors[at][0] - typical[0]).abs());
            let next = at + 1;
            if next % grid.width != 0 && next < grid.cells.len() && grid.cells[next] == Cell::Inside {
                steps += f64::from((grid.colors[next][0] - grid.colors[at][0]).abs());
                pairs += 1;
            }
        }
        let (steps, away) = (steps / pairs.max(1) as f64, away / all.len() as f64);
        Some(Self {
            roughness: if away > 0.0 { steps / away } else { 0.0 },
            typical,
            sunlit: median(high, most)?,
            shaded: median(least, low)?,
            spread: spread / all.len() as f64,
            count: all.len(),
        })
    }
}

/// Takes out cells with the hue of the background in them, more than a third of the way from the usual hue to it.
fn drop_mixed(grid: &Grid, cells: &mut Vec<usize>) {
    let Some([_, a, b]) = grid.background else { return };
    let middle = |axis: usize| {
        let mut values: Vec<f32> = cells.iter().map(|&at| grid.colors[at][axis]).collect();
        quantile(&mut values, 0.5)
    };
    let (Some(from_a), Some(from_b)) = (middle(1), middle(2)) else { return };
    let way = [a - from_a, b - from_b];
    let square = way[0] * way[0] + way[1] * way[1];
    if square > APART * APART {
        cells.retain(|&at| {
            let [_, a, b] = grid.colors[at];
            way[0] * (a - from_a) + way[1] * (b - from_b) < square / 3.0
        });
    }
}
