//! What a thread draws on. Several that draw parts of a tree have a sheet each, and these are laid over each other.
//!
//! The picture is the same, whatever is drawn on which sheet and in which order. What is left out is hidden: all of the
//! samples in its box are set, or lie in pixels that are black already. Shapes cover no sample outside their box, since
//! samples lie at least a sixteenth of a column and half a row inside of theirs, far more than rounding makes. So
//! a pixel that comes out white has on all sheets together the samples that all shapes cover, and one that is
//! black has at least half.

use super::grid::Grid;
use super::occlusion::Occlusion;
use super::outline::Outlines;
use pleach_plant::Helpers;
use std::mem;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Parts of a tree that have to be left for helpers to be called.
const MIN_SHARED: usize = 4;
/// Pixels of the largest picture of which more than one sheet is kept: half a megabyte of samples.
const MAX_KEPT: usize = 1 << 17;

/// Samples, and what is known while they are drawn.
#[derive(Clone, Debug, Default)]
pub(super) struct Sheet {
    pub(super) grid: Grid,
    /// Pixels that are black, of trees with much to draw.
    pub(super) occlusion: Occlusion,
    pub(super) outlines: Outlines,
    /// Number of the pass over a crown that is being drawn.
    pub(super) pass: usize,
    /// Grids of helpers, kept for their memory.
    spare: Vec<Grid>,
}

impl Sheet {
    /// Draws so many parts of a tree in order; or in any, from the time on at which helpers are idle.
    pub(super) fn draw(
        &mut self,
        parts: usize,
        helpers: Option<&dyn Helpers>,
        draw: &(dyn Fn(&mut Self, usize) + Sync),
    ) {
        for part in 0..parts {
            let left = parts - part;
            if let Some(helpers) = helpers.filter(|helpers| left >= MIN_SHARED && helpers.are_idle()) {
                self.share(part, left, helpers, draw);
                return;
            }
            draw(self, part);
        }
    }

    /// Draws `count` parts from `first` on with helpers.
    fn share(
        &mut self,
        first: usize,
        count: usize,
        helpers: &dyn Helpers,
        draw: &(dyn Fn(&mut Self, usize) + Sync),
    ) {
        let (width, height, down) = self.grid.size();
        self.occlusion.share((width, height));
        let Self { occlusion, outlines, pass, .. } = &*self;
        let (occlusion, outlines, pass) = (occlusion.clone(), outlines.clone(), *pass);
        let spare = Mutex::new(mem::take(&mut self.spare));
        let blank = || {
            let mut grid = locked(&spare).pop().unwrap_or_default();
            grid.reset(width, height, down);
            let (occlusion, outlines) = (occlusion.clone(), outlines.clone());
            Self { grid, occlusion, outlines, pass, spare: Vec::new() }
        };
        // Those that no thread draws on now.
        let free = Mutex::new(vec![mem::take(self)]);
        helpers.share(count, &|next| {
            let Some(mut part) = next() else { return };
            let sheet = locked(&free).pop();
            let mut sheet = sheet.unwrap_or_else(&blank);
            loop {
                draw(&mut sheet, first + part);
                let Some(another) = next() else { break };
                part = another;
            }
            loop {
                let mut free = locked(&free);
                let Some(other) = free.pop() else {
                    free.push(sheet);
                    return;
                };
                drop(free);
                sheet.grid.unite(&other.grid);
                locked(&spare).push(other.grid);
            }
        });
        // Each thread that has drawn left one, and took all that were there.
        *self = locked(&free).pop().unwrap_or_default();
        self.occlusion.end_sharing();
        self.spare = spare.into_inner().unwrap_or_else(PoisonError::into_inner);
        if self.grid.area() > MAX_KEPT {
            self.spare.clear();
        }
    }

    /// Looks for black pixels if one shape for each `pixels_for_a_shape` was drawn since it was done last.
    pub(super) fn look(&mut self, pixels_for_a_shape: usize) {
        self.occlusion.look(&mut self.grid, pixels_for_a_shape);
    }
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
