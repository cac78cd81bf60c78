//! Which stems and fillets can matter to distances in a ball.
//!
//! A distance changes by at most a metre per metre. The distance at a ball's centre therefore shows which
//! stems may be nearest anywhere in it, exactly: inside the ball the few that are kept give the same
//! numbers, to the last bit, as all of them.

use super::cone::Cone;
use super::joint::Joint;
use glam::DVec3;
use std::ops::Range;

/// Slack of comparisons of distances in metres, for rounding.
pub(super) const SLACK: f64 = 1e-9;

/// Stems in pieces, and where they flow into each other.
#[derive(Clone, Debug)]
pub(super) struct Stems {
    pub(super) cones: Vec<Cone>,
    pub(super) joints: Vec<Joint>,
}

/// What matters in a ball.
#[derive(Clone, Debug, Default)]
pub(super) struct Nearby {
    /// Numbers of cones, in rising order.
    pub(super) cones: Vec<u32>,
    pub(super) joints: Vec<Sides>,
    /// The sides of all joints one after the other, as places in the list of cones.
    pub(super) sides: Vec<u32>,
}

/// A joint by its number, and where the cones of its two stems are in the list of sides.
#[derive(Clone, Debug)]
pub(super) struct Sides {
    pub(super) joint: u32,
    pub(super) sides: [Range<u32>; 2],
}

/// Memory to work in.
#[derive(Debug, Default)]
pub(super) struct Room {
    distances: Vec<f64>,
    kept: Vec<bool>,
    places: Vec<u32>,
}

pub(super) const fn span(range: &Range<u32>) -> Range<usize> {
    range.start as usize..range.end as usize
}

impl Nearby {
    /// Everything.
    pub(super) fn all(stems: &Stems) -> Self {
        let mut all = Self { cones: (0..stems.cones.len() as u32).collect(), ..Self::default() };
        for (i, joint) in stems.joints.iter().enumerate() {
            let sides = joint.stems.clone().map(|range| {
                let start = all.sides.len() as u32;
                all.sides.extend(range.map(|i| i as u32));
                start..all.sides.len() as u32
            });
            all.joints.push(Sides { joint: i as u32, sides });
        }
        all
    }

    /// How far each cone is from `p`.
    pub(super) fn measure(&self, stems: &Stems, p: DVec3, distances: &mut Vec<f64>) {
        distances.clear();
        distances.extend(self.cones.iter().map(|&i| stems.cones[i as usize].distance(p)));
    }

    /// What matters within `radius` metres of `center`.
    ///
    /// # Errors
    /// Whether all of it is inside, where the surface does not come there.
    pub(super) fn within(
        &self,
        stems: &Stems,
        center: DVec3,
        radius: f64,
        room: &mut Room,
    ) -> Result<Self, bool> {
        let Room { distances, kept, places } = room;
        self.measure(stems, center, distances);
        let nearest = distances.iter().copied().fold(f64::INFINITY, f64::min);
        if nearest + radius < -SLACK {
            return Err(true);
        }
        // No two distances that differ by more change places.
        let most = 2.0 * radius + SLACK;
        kept.clear();
        kept.extend(distances.iter().map(|d| *d <= nearest + most));
        let (mut near, mut swell) = (Self::default(), 0.0_f64);
        for Sides { joint, sides } in &self.joints {
            let width = stems.joints[*joint as usize].width_within(center, radius + SLACK);
            if width <= 0.0 {
                continue;
            }
            let sides = sides.each_ref().map(|side| &self.sides[span(side)]);
            let [a, b] =
                sides.map(|side| side.iter().map(|&i| distances[i as usize]).fold(f64::INFINITY, f64::min));
            // It fills something here, and what it fills can be the nearest.
            if (a - b).abs() > width + most || a.min(b) - width / 4.0 > nearest + most {
                continue;
            }
            swell = swell.max(width / 4.0);
            let mut keep = |side: &[u32], least: f64| {
                let start = near.sides.len() as u32;
                near.sides.extend(side.iter().filter(|&&i| distances[i as usize] <= least + most));
                near.sides[start as usize..].iter().for_each(|&i| kept[i as usize] = true);
                start..near.sides.len() as u32
            };
            let sides = [keep(sides[0], a), keep(sides[1], b)];
            near.joints.push(Sides { joint: *joint, sides });
        }
        if nearest - radius > SLACK + swell {
            return Err(false);
        }
        places.clear();
        for (cone, kept) in self.cones.iter().zip(kept) {
            places.push(near.cones.len() as u32);
            if *kept {
                near.cones.push(*cone);
            }
        }
        near.sides.iter_mut().for_each(|place| *place = places[*place as usize]);
        Ok(near)
    }
}
