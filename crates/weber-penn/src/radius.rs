//! Radius along a stem: taper and flare (Weber and Penn 1995, §4.4; Hewitt 2017, §3.2.1).

use pleach_tree::math;

/// What the radius of a stem depends on beside the place on it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Profile {
    /// Nominal radius at the base, in metres.
    pub(crate) base: f64,
    /// Length of the whole stem, in metres.
    pub(crate) length: f64,
    /// `taper` of the level, 0 to 3.
    pub(crate) taper: f64,
    /// `flare` on trunks, 0 elsewhere.
    pub(crate) flare: f64,
}

impl Profile {
    /// Radius in metres at `z`, 0 at the base and 1 at the tip of the whole stem.
    pub(crate) fn at(&self, z: f64) -> f64 {
        let z = z.clamp(0.0, 1.0);
        let tapered = self.tapered(z);
        if self.flare == 0.0 {
            return tapered;
        }
        let y = (1.0 - 8.0 * z).max(0.0);
        tapered * (1.0 + self.flare * (math::pow(100.0, y) - 1.0) / 100.0)
    }

    /// Without flare: a cone up to taper 1, rounded to taper 2, beads to taper 3.
    fn tapered(&self, z: f64) -> f64 {
        let taper = self.taper;
        let unit = if taper < 1.0 {
            taper
        } else if taper < 2.0 {
            2.0 - taper
        } else {
            0.0
        };
        let cone = self.base * (1.0 - unit * z);
        if taper <= 1.0 || cone <= 0.0 {
            return cone.max(0.0);
        }
        let to_tip = (1.0 - z) * self.length;
        let depth = if taper < 2.0 || to_tip < cone { 1.0 } else { taper - 2.0 };
        let from_center = if taper < 2.0 {
            to_tip
        } else {
            (to_tip - 2.0 * cone * (to_tip / (2.0 * cone) + 0.5).trunc()).abs()
        };
        if taper < 2.0 && from_center >= cone {
            return cone;
        }
        let round = (cone * cone - math::powi(from_center - cone, 2)).max(0.0).sqrt();
        (1.0 - depth) * cone + depth * round
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn profile(taper: f64, flare: f64) -> Profile {
        Profile { base: 0.5, length: 10.0, taper, flare }
    }

    #[test]
    fn conical_taper_is_a_cone() {
        assert_eq!(profile(1.0, 0.0).at(0.0), 0.5);
        assert_eq!(profile(1.0, 0.0).at(0.5), 0.25);
        assert_eq!(profile(1.0, 0.0).at(1.0), 0.0);
        assert_eq!(profile(0.0, 0.0).at(1.0), 0.5);
        assert_eq!(profile(0.4, 0.0).at(1.0), 0.5 * 0.6);
    }

    #[test]
    fn taper_two_is_a_cylinder_with_a_round_end() {
        let stem = profile(2.0, 0.0);
        assert_eq!(stem.at(0.0), 0.5);
        assert_eq!(stem.at(0.9), 0.5);
        assert!(stem.at(1.0) < 1e-9);
        // Half a radius from the tip a ball of radius r is sqrt(3)/2 r wide.
        assert!((stem.at(1.0 - 0.025) - 0.5 * 0.75_f64.sqrt()).abs() < 1e-9);
    }

    #[test]
    fn taper_three_is_a_string_of_beads() {
        let stem = profile(3.0, 0.0);
        let radii: Vec<f64> = (0..=1000).map(|i| stem.at(f64::from(i) / 1000.0)).collect();
        let peaks = radii.windows(3).filter(|w| w[1] > w[0] && w[1] >= w[2]).count();
        assert_eq!(peaks, 10, "a stem of 10 m with beads 1 m long");
        assert!(radii.iter().all(|r| (0.0..=0.5 + 1e-12).contains(r)));
        // Between 2 and 3 the beads are shallower.
        let shallow = profile(2.5, 0.0);
        let least = (0..900).map(|i| shallow.at(f64::from(i) / 1000.0)).fold(1.0, f64::min);
        assert!((least - 0.25).abs() < 0.02, "{least}");
    }

    #[test]
    fn flare_widens_the_lowest_eighth() {
        let stem = profile(1.0, 0.6);
        assert!((stem.at(0.0) - 0.5 * (1.0 + 0.6 * 0.99)).abs() < 1e-12);
        assert_eq!(stem.at(0.125), profile(1.0, 0.0).at(0.125));
        assert!(stem.at(0.05) > profile(1.0, 0.0).at(0.05));
    }
}
