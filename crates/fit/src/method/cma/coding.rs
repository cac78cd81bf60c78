//! Genes as coordinates of a normal distribution, and back.
//!
//! The range of every gene is the interval from 0 to 1. Real numbers beyond it are mirrored at its
//! ends, or go around where the range is a circle. A whole number is that of the cell in which a coordinate lies, the cells at the ends going on
//! without end; the names of a choice have cells of equal width.

use crate::space::Gene;

/// The coordinate that stands for `value`.
pub(super) fn encode(gene: &Gene, value: f64) -> f64 {
    if gene.is_choice() {
        (value - gene.low + 0.5) / gene.count()
    } else {
        gene.to_unit(value).clamp(0.0, 1.0)
    }
}

/// The value for which `x` stands.
pub(super) fn decode(gene: &Gene, x: f64) -> f64 {
    if gene.is_choice() {
        gene.clamp(gene.low + (x.clamp(0.0, 1.0) * gene.count()).floor())
    } else if gene.kind.is_whole() {
        gene.from_unit(x.clamp(0.0, 1.0))
    } else if gene.is_periodic() {
        gene.from_unit(x)
    } else {
        gene.from_unit(mirrored(x))
    }
}

/// The ends of the cell in which `x` lies, infinite where there is no neighbour. `None` for a real
/// number.
pub(super) fn cell(gene: &Gene, x: f64) -> Option<(f64, f64)> {
    if !gene.kind.is_whole() {
        return None;
    }
    let value = decode(gene, x);
    let above = |value: f64| {
        if gene.is_choice() { (value - gene.low + 1.0) / gene.count() } else { gene.to_unit(value + 0.5) }
    };
    let low = if value > gene.low { above(value - 1.0) } else { f64::NEG_INFINITY };
    let high = if value < gene.high { above(value) } else { f64::INFINITY };
    Some((low, high))
}

/// `x` folded into 0..=1 at the ends.
fn mirrored(x: f64) -> f64 {
    let folded = x.rem_euclid(2.0);
    if folded > 1.0 { 2.0 - folded } else { folded }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::{Freedom, SearchSpace, TreeSeed};
    use crate::testing::{choice, integer, params, real};

    #[test]
    fn cells_hold_the_values_that_they_stand_for() {
        let params = params(vec![real("a", 0.0, 2.0), integer("n", 1, 9), integer("m", 1, 500), choice("c")]);
        let base = params.defaults();
        let space = SearchSpace::from_params(params, &base, &Freedom::default(), TreeSeed::Fixed(1)).unwrap();
        let [real, wholes @ ..] = space.genes() else { panic!("four genes") };
        assert_eq!((decode(real, -0.25), decode(real, 1.25), decode(real, 2.25)), (0.5, 1.5, 0.5));
        assert_eq!(cell(real, 0.5), None);
        for gene in wholes {
            for i in 0..gene.count() as usize {
                let value = gene.low + i as f64;
                let x = encode(gene, value);
                assert_eq!(decode(gene, x), value);
                let (low, high) = cell(gene, x).unwrap();
                assert!(low < x && x < high);
                for (end, inside) in [(low, value), (high, value + 1.0)] {
                    if end.is_finite() {
                        assert_eq!(decode(gene, end + 1e-9), inside);
                    }
                }
            }
        }
    }
}
