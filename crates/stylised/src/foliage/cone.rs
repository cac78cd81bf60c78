//! Cones of tiers around trunks: Christmas trees, which the report leaves to future work.

use super::{RADIUS, Surface};
use crate::draws::FOLIAGE;
use crate::params::{Id, Numbers};
use crate::skeleton::Skeleton;
use crate::write::{Budget, Writer};
use glam::{DVec3, dvec3};
use pleach_tree::trig::sin_cos;
use pleach_tree::{GrowError, Key};
use std::f64::consts::TAU;

/// Sides at each level of detail.
const SIDES: [u32; 4] = [8, 14, 24, 40];
/// Radius at the bottom, over that of a blob.
const SPREAD: f64 = 1.6;
/// Where the cone starts, as a part of the trunk, and how far it rises above it, over its own length.
const BOTTOM: f64 = 0.2;
const ABOVE: f64 = 0.12;
/// How much narrower a tier is where it meets the next one than that one's rim.
const NECK: f64 = 0.55;
/// By how much every second side of a rim is drawn in.
const SCALLOP: f64 = 0.1;

/// What draws of a cone are for.
mod purpose {
    pub(super) const TURN: u32 = 0;
    pub(super) const SIDE: u32 = 1;
}

pub(super) fn grow(
    surface: &mut Surface,
    numbers: &Numbers,
    skeleton: &Skeleton,
    key: Key,
    budget: &mut Budget,
    writer: &mut Writer<'_>,
) -> Result<(), GrowError> {
    let sides = SIDES[numbers.subdivision.min(3) as usize];
    let tiers = 2 + (5.0 * numbers.leaves_quantity / 100.0).round() as u32;
    let radius = SPREAD * RADIUS * numbers.leaves_size;
    for trunk in 0..skeleton.trunk_count {
        let key = skeleton.key_on(trunk, key.child(FOLIAGE, trunk));
        let path = skeleton.trunk(trunk);
        let length = path.length();
        let (low, above) = (BOTTOM * length, ABOVE * length.max(radius));
        // The axis goes on upwards beyond the trunk's end.
        let axis = |up: f64| {
            let along = low + (length + above - low) * up;
            path.at(along).point + DVec3::Z * (along - length).max(0.0)
        };
        let profile = profile(tiers);
        let turn = key.unit(purpose::TURN, 0);
        budget.spend(u64::from(sides) * profile.len() as u64, Id::leaves_quantity)?;
        surface.clear();
        for &(up, width, is_rim) in &profile {
            let center = axis(up);
            for side in 0..sides {
                let (sin, cos) = sin_cos(TAU * (turn + f64::from(side) / f64::from(sides)));
                let uneven = 1.0 + 0.15 * numbers.leaves_randomness * key.signed(purpose::SIDE, side);
                let scallop = if is_rim && side % 2 == 1 { 1.0 - SCALLOP } else { 1.0 };
                let out = radius * width * uneven * scallop;
                surface.vertices.push(center + dvec3(cos, sin, 0.0) * out);
            }
        }
        surface.vertices.extend([axis(0.4 / f64::from(tiers)), axis(1.0)]);
        surface.close_rings(profile.len() as u32, sides);
        writer.blob(trunk, &surface.vertices, &surface.triangles)?;
    }
    Ok(())
}

/// Height, width and whether it is a tier's rim, of each ring, 0 to 1, from the bottom up.
///
/// A tier reaches a little above the next one's rim, where it is narrower than that rim, so that the
/// outline never crosses itself: a rim has at least 0.36 of the width of the one below.
fn profile(tiers: u32) -> Vec<(f64, f64, bool)> {
    let count = f64::from(tiers);
    let rim = |tier: u32| 1.0 - 0.9 * f64::from(tier) / count;
    let mut profile = vec![(0.0, rim(0), true)];
    for tier in 1..tiers {
        let up = f64::from(tier) / count;
        profile.push((up + 0.25 / count, NECK * rim(tier), false));
        profile.push((up, rim(tier), true));
    }
    profile
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rim_lies_outside_the_tier_below_scalloped_or_not() {
        for tiers in 2..=7 {
            let profile = profile(tiers);
            for at in profile.windows(3).step_by(2) {
                let [(low, wide, _), (neck, narrow, _), (up, rim, is_rim)] = [at[0], at[1], at[2]];
                let here = wide + (narrow - wide) * (up - low) / (neck - low);
                assert!(is_rim && here < (1.0 - SCALLOP) * rim, "{tiers}: {here} {rim}");
            }
        }
    }
}
