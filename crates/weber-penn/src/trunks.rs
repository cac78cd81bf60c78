//! Where several trunks stand (Hewitt 2017, §3.2.1 *Multiple Trunks*).
//!
//! Poisson discs by dart throwing. The sizes of the disc and of the spacing are those of the public
//! add-on, for which bamboo was tuned. Where darts keep failing the disc grows a little, so that
//! any number of trunks ends.

use crate::budget::{Budget, Cause, DARTS_A_STEP, Exceeded};
use crate::model::Model;
use crate::purpose;
use glam::DVec2;
use pleach_tree::{Key, math};
use std::f64::consts::TAU;

/// Darts thrown for one trunk before the disc grows.
const TRIES: u32 = 32;
const GROWTH: f64 = 1.1;

/// Positions of the trunks on the ground, in metres; a single one stands at the origin.
pub(crate) fn sites(
    model: &Model,
    key: Key,
    sites: &mut Vec<DVec2>,
    budget: &mut Budget<'_>,
) -> Result<(), Exceeded> {
    sites.clear();
    if model.trunks() <= 1 {
        sites.push(DVec2::ZERO);
        return Ok(());
    }
    let trunk = &model.levels[0];
    let mut disc = (f64::from(model.trunks()) / 2.5 * model.g_scale * model.ratio).sqrt();
    let length = trunk.length + key.signed(purpose::DART_SPACING, 0) * trunk.length_v;
    let spacing = 2.5 * model.ratio * trunk.radius_mod * (model.g_scale + model.g_scale_v) * length.max(0.0);
    for i in 0..model.trunks() {
        let dart_key = key.child(purpose::DART, i);
        for attempt in 0.. {
            budget.work(Cause::Darts, 0, 1 + sites.len() as u64 / DARTS_A_STEP)?;
            let distance = disc * dart_key.unit(purpose::DART_DISTANCE, attempt).sqrt();
            let (sin, cos) = math::sin_cos(TAU * dart_key.unit(purpose::DART_AZIMUTH, attempt));
            let dart = DVec2::new(cos, sin) * distance;
            if sites.iter().all(|p| p.distance_squared(dart) >= spacing * spacing) {
                sites.push(dart);
                break;
            }
            if attempt % TRIES == TRIES - 1 {
                disc *= GROWTH;
            }
        }
    }
    Ok(())
}
