//! Individuals whose crowns grow into the hull of a goal.

use pleach_fit::{FitProblem, Genome, GoalView, IndividualSettings, individuals};
use pleach_silhouette::{Bitmap, Frame, View};
use std::sync::atomic::AtomicBool;
use std::time::Duration;

static GO: AtomicBool = AtomicBool::new(false);

/// A tree of ten metres whose crown is two balls, the larger one on the left, on a trunk that leans to the left.
fn goal(mirrored: bool) -> GoalView {
    let picture = Bitmap::from_fn(120, 120, |x, y| {
        let (x, y) = (f64::from(if mirrored { 119 - x } else { x }) - 59.5, 119.5 - f64::from(y));
        let is_ball = |at: (f64, f64), radius: f64| (x - at.0).hypot(y - at.1) < radius;
        // A speckle of paper, as leaves leave it.
        let is_leafy = (x * 7.0 + y * 13.0).rem_euclid(5.0) > 1.0;
        (x + 0.2 * y).abs() < 3.0 && y < 70.0
            || is_leafy && (is_ball((-22.0, 85.0), 30.0) || is_ball((24.0, 60.0), 16.0))
    });
    let frame =
        Frame { width: 120, height: 120, meters_per_pixel: 0.1, axis_column: 60.0, ground_row: 120.0 };
    GoalView::new(picture, View::FRONT, frame)
}

#[test]
fn a_crown_of_either_family_takes_the_form_of_the_goal() {
    for (species, least) in [("english_oak", 0.4), ("quaking_aspen", 0.33)] {
        for mirrored in [false, true] {
            let start = pleach_generators::preset(species).unwrap();
            let mut values = start.params.values().to_vec();
            let size = start.generator.hull_height(&values).unwrap();
            assert!(start.generator.resize(&mut values, 11.0 / size));
            let problem = FitProblem::new(start, goal(mirrored));
            let settings = IndividualSettings::trees(160);
            let genome = Genome::new(values, 1);
            let found =
                individuals(&problem, &genome, settings, &|| Duration::ZERO, &GO, |_| ()).unwrap().remove(0);
            let (before, after) = (found.before.iou, found.score.iou);
            assert!(found.individual().hull().is_some(), "{species}");
            assert!(after > before + 0.1 && after > least, "{species}: {before} {after}");
        }
    }
}
