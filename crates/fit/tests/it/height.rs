//! Trees that are nearly as high as their goal are drawn at another scale and not grown again.

use pleach_fit::{Evaluator, FIT_LIMITS, Genome, Objective};

/// What the first size of a list costs, drawn at the goal's height, against what the list costs whose tree grows to
/// that height. On one of the fifteen, the birch, a scale that is another in the last places moves the cost by
/// 0.03, drawn or grown.
#[test]
fn what_is_nearly_of_the_right_height_scores_as_if_it_were() {
    let mut differences = Vec::new();
    for name in pleach_generators::HEWITT_2017 {
        let problem = crate::common::goal_of(name, 1, 256);
        let evaluator =
            Evaluator::new(&problem, Objective::Balance, FIT_LIMITS).unwrap().with_height_matching();
        let mut memory = evaluator.workspace();
        let mut score = |factors: &[f64]| {
            let mut values = problem.start.params.values().to_vec();
            assert!(factors.iter().all(|&factor| problem.start.generator.resize(&mut values, factor)));
            evaluator.evaluate(&Genome::new(values, 1), &mut memory)
        };
        for factor in [0.9, 1.12] {
            let drawn = score(&[factor]);
            let grown = score(&[factor, drawn.resized]);
            assert!(drawn.resized != 1.0 && grown.resized == 1.0, "{name} by {factor}: {drawn:?} {grown:?}");
            differences.push((drawn.cost - grown.cost).abs());
        }
    }
    differences.sort_by(f64::total_cmp);
    assert!(differences[differences.len() / 2] < 0.002, "{differences:?}");
    assert!(differences[differences.len() - 3] < 0.01, "{differences:?}");
}
