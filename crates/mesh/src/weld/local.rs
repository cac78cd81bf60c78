//! The distance to the surface near a place, asked for many points.

use super::cone::Cone;
use super::joint::{Joint, filled};
use super::nearby::{Nearby, SLACK, Sides, Stems, span};
use glam::DVec3;
use std::ops::Range;

/// What matters around a point, nearest first, so that most questions end early.
#[derive(Debug)]
pub(super) struct Local {
    center: DVec3,
    cones: Vec<Cone>,
    /// How far each is from the centre, in rising order.
    bounds: Vec<f64>,
    joints: Vec<(Joint, [Range<u32>; 2])>,
    /// The cones of the joints' sides, in rising order.
    sides: Vec<u32>,
    /// How far each cone is from the point in question, NaN where it is not known yet.
    known: Vec<f64>,
}

impl Local {
    /// What matters around `center`.
    pub(super) fn new(stems: &Stems, nearby: &Nearby, center: DVec3) -> Self {
        let mut known = Vec::new();
        nearby.measure(stems, center, &mut known);
        let mut order: Vec<u32> = (0..known.len() as u32).collect();
        order.sort_unstable_by(|&i, &j| known[i as usize].total_cmp(&known[j as usize]).then(i.cmp(&j)));
        let cones = order.iter().map(|&i| stems.cones[nearby.cones[i as usize] as usize]).collect();
        let bounds = order.iter().map(|&i| known[i as usize]).collect();
        let joint = |Sides { joint, sides }: &Sides| (stems.joints[*joint as usize].clone(), sides.clone());
        let mut local = Self {
            center,
            cones,
            bounds,
            joints: nearby.joints.iter().map(joint).collect(),
            sides: nearby.sides.clone(),
            known,
        };
        let mut places = vec![0; order.len()];
        order.iter().enumerate().for_each(|(place, &i)| places[i as usize] = place as u32);
        local.sides.iter_mut().for_each(|i| *i = places[*i as usize]);
        for side in local.joints.iter().flat_map(|(_, sides)| sides) {
            local.sides[span(side)].sort_unstable();
        }
        local
    }

    /// Metres from `p` to the surface, negative inside.
    pub(super) fn distance(&mut self, p: DVec3) -> f64 {
        let Self { center, cones, bounds, joints, sides: all, known } = self;
        let away = p.distance(*center) + SLACK;
        known.fill(f64::NAN);
        let mut ask = |i: usize| {
            if known[i].is_nan() {
                known[i] = cones[i].distance(p);
            }
            known[i]
        };
        let mut nearest = f64::INFINITY;
        for (i, bound) in bounds.iter().enumerate() {
            // This one and all after it are farther.
            if bound - away > nearest {
                break;
            }
            nearest = nearest.min(ask(i));
        }
        for (joint, sides) in joints {
            let sides = sides.each_ref().map(|side| &all[span(side)]);
            // A side that is farther than this fills nothing that would be the nearest.
            let most = |width: f64| nearest + 1.25 * width;
            let first = sides.map(|side| side.first().map_or(f64::INFINITY, |&i| bounds[i as usize]));
            if first[0].max(first[1]) - away > most(joint.width) {
                continue;
            }
            let width = joint.width_at(p);
            if width <= 0.0 {
                continue;
            }
            let most = most(width);
            let mut least = |side: &[u32]| {
                let mut least = f64::INFINITY;
                for &i in side {
                    if bounds[i as usize] - away > least.min(most) {
                        break;
                    }
                    least = least.min(ask(i as usize));
                }
                least
            };
            let (a, b) = (least(sides[0]), least(sides[1]));
            if a.max(b) < f64::INFINITY {
                nearest = nearest.min(filled(a, b, width));
            }
        }
        nearest
    }
}
