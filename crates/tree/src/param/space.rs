//! The parameters of one generator laid out as slots.

use super::checked::CheckedParams;
use super::declaration::{Kind, Layout, Param};
use super::error::{Problem, SlotError};

/// One number of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slot {
    /// Index of the parameter in [`ParamSpace::params`].
    pub param: usize,
    /// Which of its numbers: the level, or 0 to 2 for x to z.
    pub index: usize,
}

/// The parameters of a generator, and their slots in order of declaration.
#[derive(Clone, Debug, PartialEq)]
pub struct ParamSpace {
    params: Vec<Param>,
    slots: Vec<Slot>,
    first_slot: Vec<usize>,
}

impl ParamSpace {
    /// Lays out `params`.
    ///
    /// # Panics
    /// If a declaration contradicts itself (default of the wrong length or out of range, twice the
    /// same name): a mistake in a generator, never in a user's file.
    #[must_use]
    pub fn new(params: Vec<Param>) -> Self {
        let mut slots = Vec::new();
        let mut first_slot = Vec::new();
        for (p, param) in params.iter().enumerate() {
            assert!(
                params[..p].iter().all(|other| other.name != param.name),
                "`{}` declared twice",
                param.name
            );
            assert_eq!(param.default.len(), param.layout.len(), "default of `{}`", param.name);
            assert!(
                matches!(param.search.len(), 1) || param.search.len() == param.layout.len(),
                "search of `{}`",
                param.name
            );
            first_slot.push(slots.len());
            for index in 0..param.layout.len() {
                let (value, (low, high)) = (param.default[index], param.search_range(index));
                assert_eq!(param.kind.repair(value), value, "default of `{}`", param.name);
                assert!(
                    low <= high && param.kind.repair(low) == low && param.kind.repair(high) == high,
                    "search of `{}`",
                    param.name
                );
                slots.push(Slot { param: p, index });
            }
        }
        Self { params, slots, first_slot }
    }

    /// The parameters in order of declaration.
    #[must_use]
    pub fn params(&self) -> &[Param] {
        &self.params
    }

    /// All slots in order.
    #[must_use]
    pub fn slots(&self) -> &[Slot] {
        &self.slots
    }

    /// Number of slots.
    #[must_use]
    pub fn len(&self) -> usize {
        self.slots.len()
    }

    /// Whether there is no parameter at all.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.slots.is_empty()
    }

    /// The parameter that slot number `slot` belongs to.
    #[must_use]
    pub fn param_of(&self, slot: usize) -> &Param {
        &self.params[self.slots[slot].param]
    }

    /// What the number in slot number `slot` means.
    #[must_use]
    pub fn kind_of(&self, slot: usize) -> Kind {
        self.param_of(slot).kind
    }

    /// The range that searches draw slot number `slot` from.
    #[must_use]
    pub fn search_range(&self, slot: usize) -> (f64, f64) {
        self.param_of(slot).search_range(self.slots[slot].index)
    }

    /// The name of slot number `slot`: `ratio`, `length[1]`, `tropism.z`.
    #[must_use]
    pub fn slot_name(&self, slot: usize) -> String {
        let Slot { index, .. } = self.slots[slot];
        let param = self.param_of(slot);
        match param.layout {
            Layout::Scalar => param.name.to_string(),
            Layout::PerLevel => format!("{}[{index}]", param.name),
            Layout::Vector => format!("{}.{}", param.name, ["x", "y", "z"][index]),
        }
    }

    /// The parameter called `name` and its number.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<(usize, &Param)> {
        self.params.iter().enumerate().find(|(_, param)| param.name == name)
    }

    /// The slot numbers of parameter number `param`.
    #[must_use]
    pub fn slots_of(&self, param: usize) -> std::ops::Range<usize> {
        let first = self.first_slot[param];
        first..first + self.params[param].layout.len()
    }

    /// The values of a species that says nothing.
    #[must_use]
    pub fn defaults(&self) -> Vec<f64> {
        self.params.iter().flat_map(|p| p.default.iter().copied()).collect()
    }

    /// Makes every value allowed: clamped, whole where it must be.
    pub fn repair(&self, values: &mut [f64]) {
        for (slot, value) in values.iter_mut().enumerate() {
            *value = self.kind_of(slot).repair(*value);
        }
    }

    /// What is wrong with `value` in slot number `slot`, if anything.
    ///
    /// # Errors
    /// Not finite, not whole, or out of range.
    pub fn check_slot(&self, slot: usize, value: f64) -> Result<(), Problem> {
        let kind = self.kind_of(slot);
        let (min, max) = kind.range();
        if !value.is_finite() {
            Err(Problem::NotFinite { value })
        } else if !(min..=max).contains(&value) {
            Err(Problem::OutOfRange { value, min, max })
        } else if kind.is_whole() && value.fract() != 0.0 {
            Err(Problem::NotWhole { value })
        } else {
            Ok(())
        }
    }

    /// Checks a whole list of values, one a slot.
    ///
    /// # Errors
    /// The first slot whose value is not allowed.
    pub fn check(&self, values: Vec<f64>) -> Result<CheckedParams, SlotError> {
        self.check_all(&values)?;
        Ok(CheckedParams::trust(values))
    }

    pub(super) fn check_all(&self, values: &[f64]) -> Result<(), SlotError> {
        if values.len() != self.len() {
            let problem = Problem::WrongLength { expected: self.len(), found: values.len() };
            return Err(SlotError { slot: "all parameters".to_owned(), problem });
        }
        for (slot, &value) in values.iter().enumerate() {
            self.check_slot(slot, value)
                .map_err(|problem| SlotError { slot: self.slot_name(slot), problem })?;
        }
        Ok(())
    }
}
