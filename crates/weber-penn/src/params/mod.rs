//! The parameters of Appendix C, declared once and read once.

mod table;

use pleach_tree::ParamSpace;
use std::sync::OnceLock;

/// The parameter space, the same for every Weber–Penn species.
pub fn space() -> &'static ParamSpace {
    static SPACE: OnceLock<ParamSpace> = OnceLock::new();
    SPACE.get_or_init(|| ParamSpace::new(table::params()))
}

/// Reads checked values in the order of the declarations; a name out of order is a bug that the
/// first debug build finds.
pub(crate) struct Cursor<'a> {
    values: &'a [f64],
    param: usize,
    slot: usize,
}

impl<'a> Cursor<'a> {
    pub(crate) const fn new(values: &'a [f64]) -> Self {
        Self { values, param: 0, slot: 0 }
    }

    fn take<const N: usize>(&mut self, name: &str) -> [f64; N] {
        let param = &space().params()[self.param];
        debug_assert_eq!((param.name.as_ref(), param.layout.len()), (name, N));
        let mut taken = [0.0; N];
        taken.copy_from_slice(&self.values[self.slot..self.slot + N]);
        self.param += 1;
        self.slot += N;
        taken
    }

    pub(crate) fn scalar(&mut self, name: &str) -> f64 {
        self.take::<1>(name)[0]
    }

    pub(crate) fn levels(&mut self, name: &str) -> [f64; 4] {
        self.take(name)
    }

    pub(crate) fn vector(&mut self, name: &str) -> [f64; 3] {
        self.take(name)
    }
}
