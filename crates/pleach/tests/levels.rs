//! Levels of detail with a budget look like the tree that they are of.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../examples/levels/compared.rs"]
mod compared;

use compared::{Compared, compare};

#[test]
fn levels_look_like_the_tree() {
    for (name, budgets) in [("acer", [8_000, 2_000]), ("hill_cherry", [8_000, 2_000])] {
        let levels = compare(name, &budgets).unwrap();
        for (budget, level) in budgets.into_iter().zip(&levels) {
            assert!(
                level.triangles <= budget.into() && level.triangles * 100 >= u64::from(budget) * 85,
                "{name} {level:?}"
            );
            let Compared { whole, halved, .. } = level;
            assert!(whole.likeness > 0.8, "{name} {budget}: {level:?}");
            assert!((0.95..1.05).contains(&whole.ink), "{name} {budget}: {level:?}");
            // Cards as large as these are a little fuller from afar.
            assert!(halved.likeness > 0.7, "{name} {budget}: {level:?}");
            assert!((0.9..1.12).contains(&halved.ink), "{name} {budget}: {level:?}");
        }
        assert!(levels.iter().any(|level| level.has_cards), "{name}: {levels:?}");
    }
}
