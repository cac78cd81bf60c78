//! The parameters of one generator laid out as slots.

use super::checked::CheckedParams;
use super::declaration::{Effect, Param, Scale, Shape};
use super::error::{Problem, SlotError};
use super::fault::{self, DeclarationError, Fault};
use super::handle::Handle;
use super::kind::Kind;
use std::ops::Range;
use std::sync::Arc;

/// One number of a generator, by its place in lists of values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Slot(u32);

impl Slot {
    /// The slot whose number stands at `index` of lists of values. A space has slots from 0 up to and
    /// without its [`ParamSpace::len`]; asking it about others panics.
    ///
    /// # Panics
    /// If `index` does not fit in 32 bits.
    #[must_use]
    pub const fn new(index: usize) -> Self {
        assert!(index <= u32::MAX as usize, "a slot's index fits in 32 bits");
        Self(index as u32)
    }

    /// Where its number stands in lists of values, from 0.
    #[must_use]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// Which number of which parameter a slot is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SlotInfo {
    /// Index of the parameter in [`ParamSpace::params`].
    pub param: usize,
    /// Which of its numbers, from 0: the level of a list by level, x to z of a vector.
    pub index: usize,
}

/// The parameters of a generator, and their slots in order of declaration.
#[derive(Clone, Debug, PartialEq)]
pub struct ParamSpace {
    params: Vec<Param>,
    slots: Vec<SlotInfo>,
    first_slot: Vec<usize>,
}

impl ParamSpace {
    /// Lays out `params`.
    ///
    /// # Errors
    /// The first declaration that contradicts itself or an earlier one.
    pub fn new(params: Vec<Param>) -> Result<Self, DeclarationError> {
        let mut slots = Vec::new();
        let mut first_slot = Vec::new();
        for (number, param) in params.iter().enumerate() {
            let is_known = params[..number].iter().any(|other| other.name == param.name);
            let fault = if is_known { Err(Fault::Twice) } else { fault::find(param) };
            fault.map_err(|fault| DeclarationError { param: param.name.to_string(), fault })?;
            first_slot.push(slots.len());
            slots.extend((0..param.shape.slot_count()).map(|index| SlotInfo { param: number, index }));
        }
        Ok(Self { params, slots, first_slot })
    }

    /// The parameters in order of declaration.
    #[must_use]
    pub fn params(&self) -> &[Param] {
        &self.params
    }

    /// All slots in order.
    pub fn slots(&self) -> impl ExactSizeIterator<Item = Slot> + DoubleEndedIterator + Clone + use<> {
        (0..self.slots.len()).map(Slot::new)
    }

    /// Number of slots.
    #[must_use]
    pub fn len(&self) -> usize {
        self.slots.len()
    }

    /// Whether the space is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.slots.is_empty()
    }

    /// Which number of which parameter `slot` is.
    #[must_use]
    pub fn info(&self, slot: Slot) -> SlotInfo {
        self.slots[slot.index()]
    }

    /// The parameter that `slot` belongs to.
    #[must_use]
    pub fn param_of(&self, slot: Slot) -> &Param {
        &self.params[self.info(slot).param]
    }

    /// What the number in `slot` means.
    #[must_use]
    pub fn kind_of(&self, slot: Slot) -> &Kind {
        &self.param_of(slot).kind
    }

    /// The range that searches draw the number in `slot` from.
    #[must_use]
    pub fn search_range(&self, slot: Slot) -> (f64, f64) {
        self.param_of(slot).search_range(self.info(slot).index)
    }

    /// The numbers in `slot` of trees that anyone would draw: see [`Param::plausible`].
    #[must_use]
    pub fn plausible_range(&self, slot: Slot) -> (f64, f64) {
        self.param_of(slot).plausible_range(self.info(slot).index)
    }

    /// How numbers in `slot` are compared.
    #[must_use]
    pub fn scale_of(&self, slot: Slot) -> Scale {
        self.param_of(slot).scale_of(self.info(slot).index)
    }

    /// What a small change of the number in `slot` does.
    #[must_use]
    pub fn effect_of(&self, slot: Slot) -> Effect {
        self.param_of(slot).effect_of(self.info(slot).index)
    }

    /// The handle of trees that the number in `slot` is, if it is one.
    #[must_use]
    pub fn handle_of(&self, slot: Slot) -> Option<Handle> {
        self.param_of(slot).handle_of(self.info(slot).index)
    }

    /// The value of `slot` where a species file is silent.
    #[must_use]
    pub fn default_of(&self, slot: Slot) -> f64 {
        self.param_of(slot).default[self.info(slot).index]
    }

    /// The slots that [`Generator::resize`](crate::Generator::resize) multiplies. Empty for a space
    /// without sizes.
    pub fn sizes(&self) -> impl Iterator<Item = Slot> + Clone {
        self.slots().filter(|&slot| self.param_of(slot).is_size(self.info(slot).index))
    }

    /// The slots whose numbers make trees of other seeds larger or smaller
    /// ([`Effect::SizeJitter`]).
    pub fn size_jitters(&self) -> impl Iterator<Item = Slot> + Clone {
        self.slots().filter(|&slot| self.effect_of(slot) == Effect::SizeJitter)
    }

    /// The name of `slot`: `ratio`, `length[1]`, `tropism.z`.
    #[must_use]
    pub fn slot_name(&self, slot: Slot) -> String {
        let (SlotInfo { index, .. }, param) = (self.info(slot), self.param_of(slot));
        match param.shape {
            Shape::Scalar => param.name.to_string(),
            Shape::List { .. } => format!("{}[{index}]", param.name),
            Shape::Vector => format!("{}.{}", param.name, ["x", "y", "z"][index]),
        }
    }

    /// The parameter called `name` and its number.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<(usize, &Param)> {
        self.params.iter().enumerate().find(|(_, param)| param.name == name)
    }

    /// The slots of parameter number `param`.
    pub fn slots_of(&self, param: usize) -> impl ExactSizeIterator<Item = Slot> + Clone + use<> {
        self.range_of(param).map(Slot::new)
    }

    /// Where the numbers of parameter number `param` stand in lists of values.
    pub(super) fn range_of(&self, param: usize) -> Range<usize> {
        let first = self.first_slot[param];
        first..first + self.params[param].shape.slot_count()
    }

    /// Whether a search that starts from `values` leaves the number in `slot` alone, unless it is asked for:
    /// see [`Param::opt_in`].
    #[must_use]
    pub fn is_left_alone(&self, values: &[f64], slot: Slot) -> bool {
        let param = self.info(slot).param;
        self.params[param].opt_in && self.slots_of(param).all(|s| values[s.index()] == self.default_of(s))
    }

    /// The values of a species that says nothing.
    #[must_use]
    pub fn defaults(&self) -> Vec<f64> {
        self.params.iter().flat_map(|p| p.default.iter().copied()).collect()
    }

    /// Makes every value allowed: clamped, whole where it must be.
    pub fn repair(&self, values: &mut [f64]) {
        for (slot, value) in self.slots().zip(values) {
            *value = self.kind_of(slot).repair(*value);
        }
    }

    /// What is wrong with `value` in `slot`, if anything.
    ///
    /// # Errors
    /// Not finite, not whole, or out of range.
    pub fn check_slot(&self, slot: Slot, value: f64) -> Result<(), Problem> {
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

    /// Checks a whole list of values, one for each slot.
    ///
    /// # Errors
    /// The first slot whose value is not allowed.
    pub fn check(self: &Arc<Self>, values: Vec<f64>) -> Result<CheckedParams, SlotError> {
        self.check_all(&values)?;
        Ok(CheckedParams::trust(Arc::clone(self), values))
    }

    /// What [`ParamSpace::check`] says of `values`, which stay the caller's.
    ///
    /// # Errors
    /// As [`ParamSpace::check`].
    pub fn check_all(&self, values: &[f64]) -> Result<(), SlotError> {
        if values.len() != self.len() {
            let problem = Problem::WrongLength { expected: self.len(), found: values.len() };
            return Err(SlotError { slot: "all parameters".to_owned(), problem });
        }
        for (slot, &value) in self.slots().zip(values) {
            self.check_slot(slot, value)
                .map_err(|problem| SlotError { slot: self.slot_name(slot), problem })?;
        }
        Ok(())
    }
}
