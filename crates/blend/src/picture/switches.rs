//! Lines of the plane where choices switch.

use super::Sheet;
use super::contour::{self, Grid};
use crate::error::BlendError;
use crate::map::BlendMap;
use crate::plane::Point;
use pleach_tree::{Kind, Slot};
use rayon::prelude::*;

/// A piece of a line where choices switch, between two points of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Switch {
    /// Its ends.
    pub ends: [Point; 2],
    /// How many choices, signs and numbers of levels differ across it; at least 1.
    pub count: f64,
}

/// The lines inside the hull where choices and signs switch, or the number of levels does, from samples of the plane,
/// `columns` across.
///
/// # Errors
/// None for a map and its own points.
pub fn switch_lines(map: &BlendMap, columns: usize) -> Result<Vec<Switch>, BlendError> {
    switch_lines_on(map, &Sheet::new(map), columns.max(2))
}

pub(super) fn switch_lines_on(
    map: &BlendMap,
    sheet: &Sheet,
    columns: usize,
) -> Result<Vec<Switch>, BlendError> {
    let space = map.landmarks().space();
    let (points, _) = sheet.grid(columns);
    let slots: Vec<Slot> = space
        .slots()
        .filter(|&slot| space.kind_of(slot).is_choice() || space.kind_of(slot).is_flagged())
        .collect();
    let few: Vec<Slot> = space
        .slots()
        .filter(|&slot| matches!(space.kind_of(slot), Kind::Integer { min, max } if max - min < 10))
        .collect();
    let cells = points
        .par_iter()
        .map(|&point| {
            if map.hull().nearest(point).distance > 0.0 {
                return Ok(None);
            }
            let blend = map.at(point)?;
            let values = blend.params.values();
            let generator = &map.landmarks().species()[blend.weights.dominant()].generator;
            let read =
                |slot: Slot, value: f64| if generator.is_active(values, slot) { value } else { f64::NAN };
            let value = |slot: Slot| blend.params.get(slot);
            let sign = |slot: &Slot| read(*slot, if value(*slot) < 0.0 { -1.0 } else { 1.0 });
            let choice = |slot: &Slot| read(*slot, value(*slot));
            let switch =
                |slot: &Slot| if space.kind_of(*slot).is_flagged() { sign(slot) } else { choice(slot) };
            Ok(Some(slots.iter().map(switch).chain(few.iter().map(choice)).collect::<Vec<f64>>()))
        })
        .collect::<Result<Vec<Option<Vec<f64>>>, BlendError>>()?;
    let grid = Grid { columns, cells };
    let differing = |a: &Vec<f64>, b: &Vec<f64>| {
        // Values that are not active are NaN and differ from nothing.
        a.iter().zip(b).filter(|(a, b)| !a.is_nan() && !b.is_nan() && a != b).count() as f64
    };
    let step = (sheet.high.x - sheet.low.x) / (columns - 1) as f64;
    let place = |p: (f64, f64)| Point { x: sheet.low.x + p.0 * step, y: sheet.high.y - p.1 * step };
    let pieces = contour::boundaries(&grid, differing).into_iter();
    Ok(pieces.map(|(ends, count)| Switch { ends: ends.map(place), count }).collect())
}
