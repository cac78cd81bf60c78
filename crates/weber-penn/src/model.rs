//! What follows from the numbers of a species.

use pleach_tree::math;

pub(crate) use crate::params::table::{Level, Model};

impl Level {
    /// Whether the stems of this level are helices.
    pub(crate) fn is_helix(&self) -> bool {
        self.curve_v < 0.0
    }
}

impl Model {
    /// Number of trunks: `floor_splits`, or the trunk level's `branches` where that is 0.
    pub(crate) fn trunks(&self) -> u32 {
        if self.floor_splits > 0 { self.floor_splits } else { (self.levels[0].branches.abs() as u32).max(1) }
    }

    /// The parameters of the children, or the leaves, of a stem of level `level`.
    pub(crate) const fn child_level(&self, level: usize) -> &Level {
        &self.levels[if level + 1 < 4 { level + 1 } else { 3 }]
    }

    /// Radius of the pruning envelope over its largest (Weber and Penn 1995, §4.6) at `q`, 0 at its
    /// top and 1 at its foot; 0 outside.
    ///
    /// Weber and Penn print `(1 − q)/(1 − w)` below the widest place, which jumps there unless
    /// w = 0.5; `(1 − q)/w` is continuous and the same at 0.5.
    pub(crate) fn envelope(&self, q: f64) -> f64 {
        let w = self.prune_width_peak;
        if !(0.0..=1.0).contains(&q) {
            0.0
        } else if q < 1.0 - w {
            math::pow(q / (1.0 - w), self.prune_power_high)
        } else if w > 0.0 {
            math::pow((1.0 - q) / w, self.prune_power_low)
        } else {
            1.0
        }
    }

    /// Whether `part` is below `prune_width` times the [envelope](Self::envelope) at `q`.
    ///
    /// Most points are so far inside or outside that the power need not be computed.
    pub(crate) fn is_within_envelope(&self, q: f64, part: f64) -> bool {
        let (width, w) = (self.prune_width, self.prune_width_peak);
        if (0.0..=1.0).contains(&q) && (q < 1.0 - w || w > 0.0) {
            let (base, power) = if q < 1.0 - w {
                (q / (1.0 - w), self.prune_power_high)
            } else {
                ((1.0 - q) / w, self.prune_power_low)
            };
            if let Some((least, most)) = power_bounds(base, power) {
                if part < width * least {
                    return true;
                }
                if part >= width * most {
                    return false;
                }
            }
        }
        part < width * self.envelope(q)
    }

    /// Relative length of a first-level branch at `q`, 0 at the trunk's tip and 1 where the bare base
    /// ends: Weber and Penn's `ShapeRatio` (1995, §4.3). Shape 8 is the pruning envelope's profile.
    pub(crate) fn shape_ratio(&self, q: f64) -> f64 {
        use std::f64::consts::{FRAC_PI_2, PI};
        let flame = |q: f64| if q <= 0.7 { q / 0.7 } else { (1.0 - q) / 0.3 };
        match self.shape {
            1 => 0.2 + 0.8 * math::sin(PI * q),
            2 => 0.2 + 0.8 * math::sin(FRAC_PI_2 * q),
            3 => 1.0,
            4 => 0.5 + 0.5 * q,
            5 => flame(q),
            6 => 1.0 - 0.8 * q,
            7 => 0.5 + 0.5 * flame(q),
            8 => self.envelope(q),
            _ => 0.2 + 0.8 * q,
        }
    }
}

/// Lower and upper bound of `base` to the power `power`, for comparisons that need no more; `None` outside of 0..=1 or
/// for a negative power. They are the base itself and the tangent at 1, with room for rounding.
pub(crate) fn power_bounds(base: f64, power: f64) -> Option<(f64, f64)> {
    if !(0.0..=1.0).contains(&base) || !(0.0..=1e6).contains(&power) {
        return None;
    }
    let tangent = 1.0 + power * (base - 1.0);
    let (least, most) = if power >= 1.0 { (tangent, base) } else { (base, tangent) };
    // Room for what the tangent loses when it cancels out, and for the rounding of the power.
    Some(((least - 1e-12).max(0.0) * (1.0 - 1e-9), (most + 1e-12) * (1.0 + 1e-9)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_is_between_its_bounds() {
        for i in 0..=1000 {
            let base = math::powi(f64::from(i) / 1000.0, 5);
            for power in [0.0, 1e-9, 0.3, 0.5, 1.0 - 1e-16, 1.0, 1.2, 2.0, 9.0, 1e4] {
                let (least, most) = power_bounds(base, power).unwrap();
                let exact = math::pow(base, power);
                assert!((least..=most).contains(&exact), "{base}^{power} = {exact}, {least} to {most}");
            }
        }
        assert!(power_bounds(1.1, 2.0).is_none() && power_bounds(0.5, -1.0).is_none());
        assert!(power_bounds(f64::NAN, 1.0).is_none());
    }
}
