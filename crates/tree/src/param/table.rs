//! Parameters declared as a table: [`parameters!`](crate::parameters) and what it stands on.

use super::declaration::Param;
use super::kind::Kind;
use super::space::{ParamSpace, Slot};
use std::sync::Arc;

/// The numbers of a generator as a struct with one field for each parameter, made by
/// [`parameters!`](crate::parameters).
pub trait Parameters: Sized + 'static {
    /// What decides whether a number matters: often the struct itself.
    type Facts;

    /// The rows of the table, one for each parameter, in order of declaration.
    const ROWS: &'static [Row<Self::Facts>];

    /// The declarations, laid out once for the whole program.
    ///
    /// # Panics
    /// If a declaration contradicts itself, another one or the type of its field.
    fn space() -> &'static Arc<ParamSpace>;

    /// The fields, from `values` that were checked against [`Parameters::space`].
    fn read(values: &[f64]) -> Self;

    /// Whether the number in `slot` matters to a tree of which these are the `facts`. Where activity
    /// differs between the numbers of one parameter, they say which number is asked about.
    #[must_use]
    fn is_active(slot: Slot, facts: &Self::Facts) -> bool {
        (Self::ROWS[Self::space().info(slot).param].is_active)(facts)
    }

    /// The slot of the number at `index` of parameter number `param`.
    ///
    /// # Panics
    /// If there is no such number.
    #[must_use]
    fn slot(param: usize, index: usize) -> Slot {
        let mut slots = Self::space().slots_of(param);
        slots.nth(index).expect("the parameter has a number at this index")
    }

    /// Lays out the declarations, for [`Parameters::space`].
    ///
    /// # Panics
    /// As [`Parameters::space`].
    #[must_use]
    fn lay_out() -> Arc<ParamSpace> {
        let params = Self::ROWS.iter().map(Row::param).collect();
        Arc::new(ParamSpace::new(params).unwrap_or_else(|error| panic!("{error}")))
    }
}

/// One row of a table of parameters.
#[derive(Debug)]
pub struct Row<F> {
    /// The parameter's name in species files.
    pub name: &'static str,
    /// How many numbers its field takes.
    pub len: usize,
    /// Everything else that is declared about it.
    pub declare: fn() -> Param,
    /// Whether a number of it matters.
    pub is_active: fn(&F) -> bool,
}

impl<F> Row<F> {
    /// The declaration under its name.
    fn param(&self) -> Param {
        let param = (self.declare)();
        assert!(param.name.is_empty(), "`{}` takes its name from its field: {}", self.name, param.name);
        let slots = param.shape.slot_count();
        assert!(slots == self.len, "`{}` declares {slots} numbers, its field takes {}", self.name, self.len);
        Param { name: self.name.into(), ..param }
    }
}

/// What a field of a table is read from: one number, or an array of them.
pub trait FromNumbers: Sized {
    /// How many numbers.
    const LEN: usize;

    /// Reads exactly [`FromNumbers::LEN`] numbers.
    fn from_numbers(numbers: &[f64]) -> Self;
}

macro_rules! read_one_number {
    ($($number:ty)*) => {$(
        impl FromNumbers for $number {
            const LEN: usize = 1;

            fn from_numbers(numbers: &[f64]) -> Self {
                numbers[0] as Self
            }
        }
    )*};
}

read_one_number! { f64 u16 u32 usize i32 i64 }

impl<const N: usize> FromNumbers for [f64; N] {
    const LEN: usize = N;

    fn from_numbers(numbers: &[f64]) -> Self {
        std::array::from_fn(|index| numbers[index])
    }
}

/// Takes the next field's numbers off `rest`.
#[doc(hidden)]
#[must_use]
pub fn next<T: FromNumbers>(rest: &mut &[f64]) -> T {
    let (numbers, after) = rest.split_at(T::LEN);
    *rest = after;
    T::from_numbers(numbers)
}

/// How many numbers `_reader` takes.
#[doc(hidden)]
#[must_use]
pub const fn read_len<T: FromNumbers, U>(_reader: fn(T) -> U) -> usize {
    T::LEN
}

/// The activity of a number that matters to every tree.
#[must_use]
pub const fn always<F>(_: &F) -> bool {
    true
}

/// [`Param::scalar`] for a row, which has its name from the field.
#[must_use]
pub fn scalar(kind: Kind, default: f64) -> Param {
    Param::scalar("", kind, default)
}

/// [`Param::list`] for a row, which has its name from the field.
#[must_use]
pub fn list(index: &'static str, kind: Kind, default: impl Into<Vec<f64>>) -> Param {
    Param::list("", index, kind, default)
}

/// [`Param::vector`] for a row, which has its name from the field.
#[must_use]
pub fn vector(kind: Kind, default: [f64; 3]) -> Param {
    Param::vector("", kind, default)
}

/// Declares the parameters of a generator: one row for each, in the order of their slots.
///
/// ```text
/// field: type [reader], when activity => declaration;
/// ```
///
/// | part | |
/// | --- | --- |
/// | `field` | the parameter's name in species files, and the field of the struct that it is read into. Where the two differ: `field = "name": …` |
/// | `type` | the field's type |
/// | `[reader]` | a function from a number, or from an array of numbers, to the type, such as `[f64::to_radians]`. Without one the numbers are taken as they are: see [`FromNumbers`](crate::param::table::FromNumbers) |
/// | `activity` | a function of the facts: whether the number can change the tree ([`Generator::is_active`](crate::Generator::is_active)). [`always`](crate::param::table::always) if it can change every tree |
/// | `declaration` | a [`Param`](crate::Param) by [`scalar`](crate::param::table::scalar), [`list`](crate::param::table::list) or [`vector`](crate::param::table::vector) |
///
/// The header `struct Numbers, enum Id, when Facts` names the struct, an enum with one variant for each
/// parameter, and the type that activities are functions of. From the rows follow the struct with its
/// implementation of [`Parameters`](crate::param::table::Parameters) and the enum, which knows the
/// [slots](crate::Slot) and their names:
///
/// ```
/// use pleach_tree::param::table::{Parameters, always, list, scalar};
/// use pleach_tree::{Kind, Unit};
///
/// pleach_tree::parameters! {
///     /// The numbers of a palm; angles in radians.
///     #[derive(Clone, Copy, Debug)]
///     struct Numbers, enum Id, when Numbers {
///         height: f64, when always => scalar(Kind::real(0.1, 30.0), 8.0).unit(Unit::Meters);
///         fronds: u32, when always => scalar(Kind::integer(0, 50), 12.0).unit(Unit::Count);
///         droop: f64 [f64::to_radians], when Numbers::has_fronds =>
///             scalar(Kind::real(0.0, 90.0), 45.0).unit(Unit::Degrees);
///         widths: [f64; 2], when Numbers::has_fronds =>
///             list("end", Kind::real(0.0, 1.0), [0.3, 0.1]).unit(Unit::Meters);
///     }
/// }
///
/// impl Numbers {
///     fn has_fronds(&self) -> bool {
///         self.fronds > 0
///     }
/// }
///
/// let mut values = Numbers::space().defaults();
/// assert_eq!(values, [8.0, 12.0, 45.0, 0.3, 0.1]);
/// let numbers = Numbers::read(&values);
/// assert_eq!((numbers.height, numbers.fronds, numbers.widths), (8.0, 12, [0.3, 0.1]));
/// assert_eq!(numbers.droop, std::f64::consts::FRAC_PI_4);
///
/// assert_eq!(Id::widths.slot_name(1), "widths[1]");
/// assert!(Numbers::is_active(Id::droop.slot(0), &numbers));
/// values[Id::fronds.slot(0).index()] = 0.0;
/// assert!(!Numbers::is_active(Id::droop.slot(0), &Numbers::read(&values)));
/// ```
///
/// # Lists as structs
///
/// Lists that are numbered alike, such as one number for each level of branching, may be read into
/// an array of structs, one struct for each index. They stand together, after rows of single
/// parameters, and more of those may follow. A row's type and reader are then those of one number:
///
/// ```
/// use pleach_tree::Kind;
/// use pleach_tree::param::table::{Parameters, always, list, scalar};
///
/// /// The whole model, and which number of a list is asked about.
/// struct Facts {
///     model: Model,
///     index: usize,
/// }
///
/// impl Facts {
///     fn has_stems(&self) -> bool {
///         self.index < self.model.level_count
///     }
/// }
///
/// pleach_tree::parameters! {
///     struct Model, enum Id, when Facts {
///         level_count = "levels": usize, when always => scalar(Kind::integer(1, 3), 2.0);
///         /// The numbers of one level.
///         [Level; 3] levels {
///             length: f64, when Facts::has_stems =>
///                 list("level", Kind::real(0.0, 20.0), [1.0, 0.3, 0.6]);
///             angle: f64 [f64::to_radians], when Facts::has_stems =>
///                 list("level", Kind::real(0.0, 180.0), [0.0, 60.0, 45.0]);
///         }
///         leaf_size: f64, when |facts| facts.model.level_count > 1 => scalar(Kind::real(0.0, 1.0), 0.1);
///     }
/// }
///
/// let model = Model::read(&Model::space().defaults());
/// assert_eq!((model.levels[2].length, model.levels[2].angle), (0.6, std::f64::consts::FRAC_PI_4));
/// assert_eq!(Id::level_count.slot_name(0), "levels");
/// let facts = Facts { model, index: 2 };
/// assert!(!Model::is_active(Id::length.slot(2), &facts));
/// assert!(Model::is_active(Id::leaf_size.slot(0), &facts));
/// ```
#[macro_export]
macro_rules! parameters {
    (
        $(#[$meta:meta])*
        $vis:vis struct $Numbers:ident, enum $Id:ident, when $Facts:ty {
            $($f1:ident $(= $n1:literal)?: $t1:ty $([$r1:expr])?, when $a1:expr => $d1:expr;)*
            $(
                $(#[$level_meta:meta])*
                [$Level:ident; $count:expr] $levels:ident {
                    $($f2:ident $(= $n2:literal)?: $t2:ty $([$r2:expr])?, when $a2:expr => $d2:expr;)*
                }
                $($f3:ident $(= $n3:literal)?: $t3:ty $([$r3:expr])?, when $a3:expr => $d3:expr;)*
            )?
        }
    ) => {
        $(#[$meta])*
        $vis struct $Numbers {
            $($vis $f1: $t1,)*
            $($vis $levels: [$Level; $count], $($vis $f3: $t3,)*)?
        }

        $(
            $(#[$level_meta])*
            $vis struct $Level {
                $($vis $f2: $t2,)*
            }
        )?

        impl $crate::param::table::Parameters for $Numbers {
            type Facts = $Facts;

            const ROWS: &'static [$crate::param::table::Row<$Facts>] = &[
                $($crate::parameters!(@row $f1 $($n1)?, $crate::parameters!(@len $t1 $(, $r1)?), $d1, $a1),)*
                $(
                    $($crate::parameters!(@row $f2 $($n2)?, $count, $d2, $a2),)*
                    $($crate::parameters!(@row $f3 $($n3)?, $crate::parameters!(@len $t3 $(, $r3)?), $d3, $a3),)*
                )?
            ];

            fn space() -> &'static ::std::sync::Arc<$crate::ParamSpace> {
                static SPACE: ::std::sync::LazyLock<::std::sync::Arc<$crate::ParamSpace>> =
                    ::std::sync::LazyLock::new(<$Numbers as $crate::param::table::Parameters>::lay_out);
                &SPACE
            }

            // Fields are read in the order of the rows, which is that of the values.
            fn read(values: &[f64]) -> Self {
                let mut rest = values;
                $(let $f1: $t1 = $crate::parameters!(@read $crate::param::table::next(&mut rest) $(, $r1)?);)*
                $(
                    $(let $f2: [f64; $count] = $crate::param::table::next(&mut rest);)*
                    let $levels = ::std::array::from_fn(|index| $Level {
                        $($f2: $crate::parameters!(
                            @read $crate::param::table::next(&mut &$f2[index..]) $(, $r2)?
                        ),)*
                    });
                    $(let $f3: $t3 = $crate::parameters!(@read $crate::param::table::next(&mut rest) $(, $r3)?);)*
                )?
                debug_assert!(rest.is_empty(), "one value for each slot, not {} more", rest.len());
                Self { $($f1,)* $($levels, $($f3,)*)? }
            }
        }

        /// A parameter, by the field that it fills.
        #[allow(non_camel_case_types, dead_code, reason = "one for each field, called as it is")]
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        $vis enum $Id {
            $($f1,)*
            $($($f2,)* $($f3,)*)?
        }

        #[allow(dead_code, reason = "not every generator asks everything")]
        impl $Id {
            /// All of them, in order of declaration.
            $vis const ALL: &'static [Self] = &[
                $(Self::$f1,)*
                $($(Self::$f2,)* $(Self::$f3,)*)?
            ];

            /// The slot of the number at `index` of this parameter.
            $vis fn slot(self, index: usize) -> $crate::Slot {
                <$Numbers as $crate::param::table::Parameters>::slot(self as usize, index)
            }

            /// The name of the number at `index` of this parameter, as in files and messages.
            $vis fn slot_name(self, index: usize) -> String {
                <$Numbers as $crate::param::table::Parameters>::space().slot_name(self.slot(index))
            }
        }
    };
    (@row $field:ident $($name:literal)?, $len:expr, $declaration:expr, $activity:expr) => {
        $crate::param::table::Row {
            name: $crate::parameters!(@name $field $($name)?),
            len: $len,
            declare: || $declaration,
            is_active: $activity,
        }
    };
    (@name $field:ident) => { stringify!($field) };
    (@name $field:ident $name:literal) => { $name };
    (@len $type:ty) => { <$type as $crate::param::table::FromNumbers>::LEN };
    (@len $type:ty, $reader:expr) => { $crate::param::table::read_len($reader) };
    (@read $numbers:expr) => { $numbers };
    (@read $numbers:expr, $reader:expr) => { $reader($numbers) };
}

#[cfg(test)]
mod tests {
    use super::*;

    crate::parameters! {
        struct Numbers, enum Id, when usize {
            width: f64, when always => scalar(Kind::real(0.0, 1.0), 0.25);
            /// One of two levels.
            #[derive(Debug, PartialEq)]
            [Level; 2] levels {
                count: u16, when |level| *level == 1 => list("level", Kind::integer(0, 9), [3.0, 4.0]);
                lean = "angle": f64 [f64::to_radians], when always =>
                    list("level", Kind::real(0.0, 180.0), [0.0, 180.0]);
            }
            pull: f64 [|[x, y, z]: [f64; 3]| x + y + z], when always =>
                vector(Kind::real(0.0, 9.0), [1.0, 2.0, 4.0]);
            last: i64, when always => scalar(Kind::integer(-9, 9), -5.0);
        }
    }

    #[test]
    fn rows_become_declarations_fields_and_activity() {
        let space = Numbers::space();
        let names: Vec<String> = space.slots().map(|slot| space.slot_name(slot)).collect();
        let expected = "width count[0] count[1] angle[0] angle[1] pull.x pull.y pull.z last";
        assert_eq!(names.join(" "), expected);
        let numbers = Numbers::read(&space.defaults());
        let levels = [Level { count: 3, lean: 0.0 }, Level { count: 4, lean: std::f64::consts::PI }];
        assert_eq!((numbers.width, numbers.levels, numbers.pull, numbers.last), (0.25, levels, 7.0, -5));
        assert_eq!(Id::ALL, [Id::width, Id::count, Id::lean, Id::pull, Id::last]);
        assert_eq!((Id::lean.slot_name(1), Id::pull.slot(2).index()), ("angle[1]".to_owned(), 7));
        assert!(Numbers::is_active(Id::count.slot(1), &1) && !Numbers::is_active(Id::count.slot(0), &0));
    }

    mod mismatched {
        use super::super::*;

        crate::parameters! {
            #[expect(dead_code, reason = "laid out and not read")]
            struct Numbers, enum Id, when () {
                pull: f64, when always => vector(Kind::real(0.0, 9.0), [1.0, 2.0, 4.0]);
            }
        }

        #[test]
        #[should_panic(expected = "`pull` declares 3 numbers, its field takes 1")]
        fn a_field_takes_all_numbers_of_its_declaration() {
            Numbers::space();
        }
    }

    mod named_twice {
        use super::super::*;

        crate::parameters! {
            #[expect(dead_code, reason = "laid out and not read")]
            struct Numbers, enum Id, when () {
                pull: f64, when always => Param::scalar("push", Kind::real(0.0, 9.0), 1.0);
            }
        }

        #[test]
        #[should_panic(expected = "`pull` takes its name from its field: push")]
        fn a_row_has_one_name() {
            Numbers::space();
        }
    }
}
