//! What is said once about a parameter.

use super::handle::Handle;
use super::kind::Kind;
use std::borrow::Cow;
use std::fmt;

/// How many numbers a parameter has, and what they are called.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One number: `ratio`.
    Scalar,
    /// A list of numbers, one for each level, year, organ, …: `length[1]`.
    List {
        /// How many there are; at least one.
        len: usize,
        /// What they are numbered by, in one word. `level` makes `level:1` a pattern for the numbers
        /// at index 1 of all such lists.
        index: Cow<'static, str>,
    },
    /// Three numbers: `tropism.x`, `tropism.y` and `tropism.z`.
    Vector,
}

impl Shape {
    /// Number of slots.
    #[must_use]
    pub const fn slot_count(&self) -> usize {
        match self {
            Self::Scalar => 1,
            Self::List { len, .. } => *len,
            Self::Vector => 3,
        }
    }
}

/// How the values of a parameter are compared, in searches and in blends alike.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Scale {
    /// By difference.
    #[default]
    Linear,
    /// By ratio: from 1 to 2 is as far as from 10 to 20. For quantities of unknown size, with a search
    /// range above zero.
    Log,
    /// Searched like [`Scale::Log`], since the best value may be far nearer to zero than to the other
    /// end of the range, but averaged by difference, since a small value does much the same as a
    /// smaller one.
    FineNearZero,
    /// A count of things: few by difference, many by ratio, since counts multiply.
    Count,
}

/// What a small change of a number does to a tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Effect {
    /// Changes it gradually.
    #[default]
    Plain,
    /// Changes the size of the tree or of a part of it, and little else.
    /// [`Generator::resize`](crate::Generator::resize) multiplies such numbers.
    Size,
    /// Says how much larger or smaller trees of other seeds are; 0 is always allowed and means not at
    /// all. A single tree does not show it. Where its unit is metres, it is a size too.
    SizeJitter,
    /// Reshuffles the random layout of a tree: counts, what counts are computed from, angles that add up
    /// from part to part. Blends change such numbers together and in few steps.
    Layout,
}

/// The unit of a parameter's numbers, as they stand in files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Metres.
    Meters,
    /// Degrees; converted to radians when a generator reads them.
    Degrees,
    /// A count of things.
    Count,
    /// A ratio or a power: no unit.
    Ratio,
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Meters => "m",
            Self::Degrees => "°",
            Self::Count => "count",
            Self::Ratio => "ratio",
        })
    }
}

/// The one declaration of a parameter: everything that anyone asks about it, but whether it matters
/// to a tree, which depends on the other values
/// ([`Generator::is_active`](crate::Generator::is_active)).
///
/// Made by [`Param::scalar`], [`Param::list`] or [`Param::vector`] and then told more:
///
/// ```
/// use pleach_tree::param::{Effect, Kind, Param, Scale, Unit};
///
/// let height = Param::scalar("height", Kind::real(0.1, 100.0), 12.0)
///     .search([(2.0, 40.0)])
///     .unit(Unit::Meters)
///     .scale([Scale::Log])
///     .effect([Effect::Size])
///     .doc("height of the tree");
/// assert_eq!(height.search_range(0), (2.0, 40.0));
/// ```
///
/// Where a list has one entry *for each slot*, a single entry stands for all of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Param {
    /// Its name in species files.
    pub name: Cow<'static, str>,
    /// One number, a list, or a vector.
    pub shape: Shape,
    /// What its numbers mean and which are allowed.
    pub kind: Kind,
    /// Values where a species file is silent, one for each slot.
    pub default: Cow<'static, [f64]>,
    /// The ranges that searches and random lists draw from, one for each slot: narrower than what is
    /// allowed.
    pub search: Cow<'static, [(f64, f64)]>,
    /// The ranges of trees that anyone would draw, one for each slot: the search ranges or parts of
    /// them. Beyond, a tree may look right as a silhouette and be absurd; searches go no farther,
    /// unless where they start is beyond it. Empty where the search ranges say it.
    pub plausible: Cow<'static, [(f64, f64)]>,
    /// Whether searches leave its numbers alone unless they start from others than the defaults, or are
    /// asked for it by name: for features that few trees have. Each number that is searched makes the
    /// search for all others longer.
    pub opt_in: bool,
    /// How values are compared, one for each slot.
    pub scale: Cow<'static, [Scale]>,
    /// What a small change does, one for each slot.
    pub effect: Cow<'static, [Effect]>,
    /// The value that stands for the absence of what the parameter is about, such as a bend of 0, if
    /// there is one. Searches try it.
    pub neutral: Option<f64>,
    /// The values, in rising order, at which a real number starts to mean something else, though a
    /// tree changes gradually across them; empty for most. `taper` of Weber and Penn is an example: a
    /// cone up to 1, rounded up to 2, beads above. A sign that is a switch is told by [`Kind::Flagged`]
    /// instead.
    pub breakpoints: Cow<'static, [f64]>,
    /// The number among its numbers that is a [`Handle`] of trees, and which, if one is.
    pub handle: Option<(usize, Handle)>,
    /// Unit of the numbers in files.
    pub unit: Unit,
    /// A word by which several parameters can be chosen together, such as `crown` or `leaves`.
    pub group: Cow<'static, str>,
    /// One line of documentation.
    pub doc: Cow<'static, str>,
    /// Where it is defined: paper and section.
    pub source: Cow<'static, str>,
}

/// What `list` says of slot `index`: one entry stands for all slots.
fn each<T: Copy>(list: &[T], index: usize) -> T {
    if let [all] = list { *all } else { list[index] }
}

impl Param {
    /// One number. What is not said further is: searched wherever it is allowed, a ratio, compared by
    /// difference, of plain effect, without neutral value or breakpoints.
    #[must_use]
    pub fn scalar(name: impl Into<Cow<'static, str>>, kind: Kind, default: f64) -> Self {
        Self::new(name.into(), Shape::Scalar, kind, Cow::Owned(vec![default]))
    }

    /// As many numbers as `default` has, numbered by `index` (see [`Shape::List`]); for the rest as
    /// [`Param::scalar`].
    #[must_use]
    pub fn list(
        name: impl Into<Cow<'static, str>>,
        index: impl Into<Cow<'static, str>>,
        kind: Kind,
        default: impl Into<Vec<f64>>,
    ) -> Self {
        let default = default.into();
        let shape = Shape::List { len: default.len(), index: index.into() };
        Self::new(name.into(), shape, kind, Cow::Owned(default))
    }

    /// Three numbers x, y and z; for the rest as [`Param::scalar`].
    #[must_use]
    pub fn vector(name: impl Into<Cow<'static, str>>, kind: Kind, default: [f64; 3]) -> Self {
        Self::new(name.into(), Shape::Vector, kind, Cow::Owned(default.to_vec()))
    }

    fn new(name: Cow<'static, str>, shape: Shape, kind: Kind, default: Cow<'static, [f64]>) -> Self {
        Self {
            name,
            shape,
            default,
            search: Cow::Owned(vec![kind.range()]),
            kind,
            plausible: Cow::Borrowed(&[]),
            opt_in: false,
            scale: Cow::Borrowed(&[Scale::Linear]),
            effect: Cow::Borrowed(&[Effect::Plain]),
            neutral: None,
            breakpoints: Cow::Borrowed(&[]),
            handle: None,
            unit: Unit::Ratio,
            group: Cow::Borrowed("other"),
            doc: Cow::Borrowed(""),
            source: Cow::Borrowed(""),
        }
    }

    /// Sets [`Param::search`].
    #[must_use]
    pub fn search(self, ranges: impl Into<Vec<(f64, f64)>>) -> Self {
        Self { search: Cow::Owned(ranges.into()), ..self }
    }

    /// Sets [`Param::plausible`].
    #[must_use]
    pub fn plausible(self, ranges: impl Into<Vec<(f64, f64)>>) -> Self {
        Self { plausible: Cow::Owned(ranges.into()), ..self }
    }

    /// Sets [`Param::opt_in`].
    #[must_use]
    pub fn opt_in(self) -> Self {
        Self { opt_in: true, ..self }
    }

    /// Sets [`Param::scale`].
    #[must_use]
    pub fn scale(self, scales: impl Into<Vec<Scale>>) -> Self {
        Self { scale: Cow::Owned(scales.into()), ..self }
    }

    /// Sets [`Param::effect`].
    #[must_use]
    pub fn effect(self, effects: impl Into<Vec<Effect>>) -> Self {
        Self { effect: Cow::Owned(effects.into()), ..self }
    }

    /// Sets [`Param::neutral`].
    #[must_use]
    pub fn neutral(self, value: f64) -> Self {
        Self { neutral: Some(value), ..self }
    }

    /// Sets [`Param::breakpoints`].
    #[must_use]
    pub fn breakpoints(self, values: impl Into<Vec<f64>>) -> Self {
        Self { breakpoints: Cow::Owned(values.into()), ..self }
    }

    /// Sets [`Param::handle`]: the number at `index` is one.
    #[must_use]
    pub fn handle(self, index: usize, handle: Handle) -> Self {
        Self { handle: Some((index, handle)), ..self }
    }

    /// Sets [`Param::unit`].
    #[must_use]
    pub fn unit(self, unit: Unit) -> Self {
        Self { unit, ..self }
    }

    /// Sets [`Param::group`].
    #[must_use]
    pub fn group(self, group: impl Into<Cow<'static, str>>) -> Self {
        Self { group: group.into(), ..self }
    }

    /// Sets [`Param::doc`].
    #[must_use]
    pub fn doc(self, doc: impl Into<Cow<'static, str>>) -> Self {
        Self { doc: doc.into(), ..self }
    }

    /// Sets [`Param::source`].
    #[must_use]
    pub fn source(self, source: impl Into<Cow<'static, str>>) -> Self {
        Self { source: source.into(), ..self }
    }

    /// The search range of the number at `index`.
    #[must_use]
    pub fn search_range(&self, index: usize) -> (f64, f64) {
        each(&self.search, index)
    }

    /// The plausible range of the number at `index`.
    #[must_use]
    pub fn plausible_range(&self, index: usize) -> (f64, f64) {
        if self.plausible.is_empty() { self.search_range(index) } else { each(&self.plausible, index) }
    }

    /// How values of the number at `index` are compared.
    #[must_use]
    pub fn scale_of(&self, index: usize) -> Scale {
        each(&self.scale, index)
    }

    /// What a small change of the number at `index` does.
    #[must_use]
    pub fn effect_of(&self, index: usize) -> Effect {
        each(&self.effect, index)
    }

    /// The handle that the number at `index` is, if it is one.
    #[must_use]
    pub fn handle_of(&self, index: usize) -> Option<Handle> {
        self.handle.filter(|(number, _)| *number == index).map(|(_, handle)| handle)
    }

    /// Whether the number at `index` is multiplied where a tree is made larger.
    #[must_use]
    pub fn is_size(&self, index: usize) -> bool {
        match self.effect_of(index) {
            Effect::Size => true,
            Effect::SizeJitter => self.unit == Unit::Meters,
            Effect::Plain | Effect::Layout => false,
        }
    }
}
