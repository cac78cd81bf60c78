//! The parameters of Appendix C, declared once and read once.

pub(crate) mod active;
mod declare;
mod read;
pub(crate) mod table;

use pleach_tree::ParamSpace;
use pleach_tree::param::Slot;
use std::sync::{Arc, OnceLock};
use table::Id;

/// Levels of stems that parameters may differ by.
pub(crate) const LEVELS: usize = 4;

/// The parameter space, the same for every Weber–Penn species.
///
/// # Panics
/// If a declaration contradicts itself, which a test would find.
pub fn space() -> &'static Arc<ParamSpace> {
    static SPACE: OnceLock<Arc<ParamSpace>> = OnceLock::new();
    SPACE.get_or_init(|| {
        Arc::new(ParamSpace::new(table::params()).expect("the declarations are free of contradictions"))
    })
}

impl Id {
    /// The slot of the number at `index` of this parameter.
    pub(crate) fn slot(self, index: usize) -> Slot {
        let mut slots = space().slots_of(self as usize);
        slots.nth(index).expect("parameters by level are asked for by level")
    }

    /// The name of the number at `index` of this parameter, as in files and messages.
    pub(crate) fn slot_name(self, index: usize) -> String {
        space().slot_name(self.slot(index))
    }
}
