//! The parameters of Appendix C, and of how a tree stands, declared once and read once.

pub(crate) mod active;
mod declare;
mod read;
pub(crate) mod table;

use pleach_tree::ParamSpace;
use pleach_tree::param::table::Parameters;
use std::sync::Arc;
use table::Model;

/// Levels of stems that parameters may differ by.
pub(crate) const LEVELS: usize = 4;
/// Heights of the crown's outline.
pub(crate) const HEIGHTS: usize = 5;

/// The parameter space, the same for every Weber–Penn species.
///
/// # Panics
/// If a declaration contradicts itself, which a test would find.
pub fn space() -> &'static Arc<ParamSpace> {
    Model::space()
}

#[cfg(test)]
mod tests {
    use super::table::Id;
    use super::*;

    /// Each field has the numbers of its own row: those before, between and after the levels.
    #[test]
    fn values_reach_their_fields() {
        let mut values = space().defaults();
        let mut set = |id: Id, index: usize, value: f64| values[id.slot(index).index()] = value;
        set(Id::g_scale, 0, 7.5);
        set(Id::level_count, 0, 2.0);
        set(Id::base_splits, 0, -3.0);
        set(Id::base_size, 0, 0.25);
        set(Id::rotate, 3, 180.0);
        set(Id::curve_res, 2, 0.0);
        set(Id::radius_mod, 3, 1.5);
        set(Id::tropism, 2, -2.0);
        set(Id::leaf_shape, 0, 4.0);
        set(Id::prune_power_high, 0, 0.125);
        assert!(space().check_all(&values).is_ok());
        let model = Model::read(&values);
        assert_eq!((model.g_scale, model.level_count, model.base_splits), (7.5, 2, -3));
        assert_eq!((model.levels[0].base_size, model.levels[3].rotate), (0.25, std::f64::consts::PI));
        assert_eq!((model.levels[2].curve_res, model.levels[3].radius_mod), (1, 1.5));
        assert_eq!((model.tropism.z, model.leaf_shape as i64, model.prune_power_high), (-2.0, 4, 0.125));
    }
}
