//! A declaration for other programs: one set of keys for JSON wherever it is printed.

use super::declaration::{Effect, Scale, Unit};
use super::handle::Handle;
use super::kind::Kind;
use super::space::{ParamSpace, Slot};
use serde::{Serialize, Serializer};
use std::borrow::Cow;

/// All that is declared about a parameter, or about one of its numbers, under the keys that
/// `pleach params --json`, the page and Python share.
#[derive(Clone, Debug, Serialize)]
pub struct Declared<'a> {
    /// The name in species files: `length`, or `length[1]` for one number.
    pub name: Cow<'a, str>,
    /// How many numbers.
    pub values: usize,
    /// [`Kind::word`].
    pub kind: &'static str,
    /// Smallest allowed value.
    pub min: f64,
    /// Largest allowed value.
    pub max: f64,
    /// Unit of the numbers.
    pub unit: Unit,
    /// Values where a species file is silent, one for each number.
    pub default: Vec<f64>,
    /// The ranges that searches draw from: one for each number, or one for all.
    pub search: Vec<(f64, f64)>,
    /// [`Param::opt_in`](super::Param::opt_in).
    pub opt_in: bool,
    /// The group.
    pub group: &'a str,
    /// Of a choice, the number of its first name.
    pub first: Option<i64>,
    /// Of a choice, its names.
    pub choices: Option<&'a [Cow<'static, str>]>,
    /// Of a flagged number, what a negative value means.
    pub negative: Option<&'a str>,
    /// [`Param::neutral`](super::Param::neutral).
    pub neutral: Option<f64>,
    /// [`Param::breakpoints`](super::Param::breakpoints).
    pub breakpoints: &'a [f64],
    /// One line of documentation.
    pub doc: &'a str,
    /// Where it is defined.
    pub source: &'a str,
    /// What differs from number to number.
    pub slots: Vec<DeclaredSlot>,
}

/// What is declared about one number.
#[derive(Clone, Debug, Serialize)]
pub struct DeclaredSlot {
    /// Its name, such as `length[1]`.
    pub slot: String,
    /// Where it stands in lists of values.
    pub index: usize,
    /// Its value where a species file is silent.
    pub default: f64,
    /// The range that searches draw from.
    pub search: (f64, f64),
    /// The part of it in which trees look right.
    pub plausible: (f64, f64),
    /// How its values are compared.
    pub scale: Scale,
    /// What a small change does.
    pub effect: Effect,
    /// Its [`Handle`], for those few numbers that are shown first.
    pub handle: Option<Handle>,
}

impl ParamSpace {
    /// What is declared about parameter number `param`.
    #[must_use]
    pub fn declared(&self, param: usize) -> Declared<'_> {
        let declaration = &self.params()[param];
        let (min, max) = declaration.kind.range();
        let (first, choices, negative) = match &declaration.kind {
            Kind::Choice { first, names } => (Some(*first), Some(names.as_ref()), None),
            Kind::Flagged { negative, .. } | Kind::FlaggedInteger { negative, .. } => {
                (None, None, Some(negative.as_ref()))
            }
            Kind::Real { .. } | Kind::Integer { .. } => (None, None, None),
        };
        Declared {
            name: Cow::Borrowed(&declaration.name),
            values: declaration.shape.slot_count(),
            kind: declaration.kind.word(),
            min,
            max,
            unit: declaration.unit,
            default: declaration.default.to_vec(),
            search: declaration.search.to_vec(),
            opt_in: declaration.opt_in,
            group: &declaration.group,
            first,
            choices,
            negative,
            neutral: declaration.neutral,
            breakpoints: &declaration.breakpoints,
            doc: &declaration.doc,
            source: &declaration.source,
            slots: self.slots_of(param).map(|slot| self.declared_slot(slot)).collect(),
        }
    }

    /// What is declared about the number in `slot`: as about its parameter, with lists of one.
    #[must_use]
    pub fn declared_number(&self, slot: Slot) -> Declared<'_> {
        Declared {
            name: Cow::Owned(self.slot_name(slot)),
            values: 1,
            default: vec![self.default_of(slot)],
            search: vec![self.search_range(slot)],
            slots: vec![self.declared_slot(slot)],
            ..self.declared(self.info(slot).param)
        }
    }

    fn declared_slot(&self, slot: Slot) -> DeclaredSlot {
        DeclaredSlot {
            slot: self.slot_name(slot),
            index: slot.index(),
            default: self.default_of(slot),
            search: self.search_range(slot),
            plausible: self.plausible_range(slot),
            scale: self.scale_of(slot),
            effect: self.effect_of(slot),
            handle: self.handle_of(slot),
        }
    }
}

/// The list of what is declared about all parameters.
impl Serialize for ParamSpace {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq((0..self.params().len()).map(|param| self.declared(param)))
    }
}

/// As people read it: `m`, `°`, `count`, `ratio`.
impl Serialize for Unit {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
