//! Whether a point fits, and how long a stem may be (Weber and Penn 1995, §4.6).

use crate::course::Course;
use crate::model::Model;
use crate::solid::Surroundings;
use glam::DVec3;
use pleach_tree::Hull;

/// Below this part of its first length a stem is given up.
const MIN_PART: f64 = 0.15;
/// Each trial is this part of the one before.
const SHRINK: f64 = 0.9;

/// How much longer than its own numbers say a branch of the trunk may be that grows into a hull.
pub(crate) const STRETCH: f64 = 1.6;
/// The outer part of a stem that has to be in a hull: what comes before may pass through a gap of the crown.
pub(crate) const OUTER: f64 = 1.0 / 3.0;

/// Whether `point` of an upright tree, of nominal height `height`, is in `hull`, which stands for the envelope, and clear
/// of all obstacles.
pub(crate) fn is_in(
    hull: &Hull,
    surroundings: &Surroundings,
    (course, height): (Option<Course>, f64),
    point: DVec3,
) -> bool {
    let place = course.map_or(point, |course| course.place(point));
    hull.density(place / height) > 0.0 && !surroundings.obstacles.iter().any(|s| s.contains(place))
}

/// Whether `point` of an upright tree of scale `scale` is inside the envelope (or one of the solids that stand for it)
/// and clear of all obstacles. The envelope leans with the tree on its `course`; solids do not.
pub(crate) fn fits(
    model: &Model,
    surroundings: &Surroundings,
    (course, scale): (Option<Course>, f64),
    point: DVec3,
) -> bool {
    let place = course.map_or(point, |course| course.place(point));
    let inside = match &surroundings.inside {
        Some(solids) => solids.is_empty() || solids.iter().any(|s| s.contains(place)),
        None => {
            let foot = scale * (1.0 - model.levels[0].base_size);
            let q = (scale - point.z) / foot;
            model.is_within_envelope(q, point.truncate().length() / scale)
        }
    };
    inside && !surroundings.obstacles.iter().any(|s| s.contains(place))
}

/// The length that a stem of nominal length `length` is pruned to, given a test of whether it fits
/// at a length; `None` if it is dropped. `ratio` is `prune_ratio`, above 0.
///
/// # Errors
/// That of the test.
pub(crate) fn pruned_length<E>(
    ratio: f64,
    length: f64,
    mut fits_at: impl FnMut(f64) -> Result<bool, E>,
) -> Result<Option<f64>, E> {
    let mut trial = length;
    while !fits_at(trial)? {
        trial *= SHRINK;
        // Also for a length of zero, which no shrinking ends, and for one that is not a number.
        if trial <= MIN_PART * length || trial.is_nan() {
            if ratio >= 1.0 {
                return Ok(None);
            }
            trial = 0.0;
            break;
        }
    }
    Ok(Some((1.0 - ratio) * length + ratio * trial))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    fn pruned(ratio: f64, fits_at: impl Fn(f64) -> bool) -> Option<f64> {
        pruned_length(ratio, 10.0, |length| Ok::<_, Infallible>(fits_at(length))).unwrap()
    }

    #[test]
    fn the_ratio_interpolates_between_the_fitting_length_and_the_whole() {
        let at_most_half = |length: f64| length <= 5.0;
        let full = pruned(1.0, at_most_half).unwrap();
        assert!(full <= 5.0 && full > 4.4, "{full}");
        let half = pruned(0.5, at_most_half).unwrap();
        assert!((half - (10.0 + full) / 2.0).abs() < 1e-12);
        assert_eq!(pruned(1.0, |_| true), Some(10.0));
    }

    #[test]
    fn what_never_fits_is_dropped_only_at_ratio_one() {
        assert_eq!(pruned(1.0, |_| false), None);
        assert_eq!(pruned(0.25, |_| false), Some(7.5));
    }
}
