//! How a row of the table becomes declaration, field, reader and activity.

use super::LEVELS;
use pleach_tree::Param;
use pleach_tree::param::Kind;

/// Where all of them are defined.
const SOURCE: &str = "Hewitt 2017, Appendix C";

/// One number, without its name.
pub(super) fn scalar(group: &'static str, doc: &'static str, kind: Kind, default: f64) -> Param {
    Param::scalar("", kind, default).group(group).doc(doc).source(SOURCE)
}

/// One number for each level, without its name: 0 the trunk, 3 the deepest twigs and the leaves.
pub(super) fn levels(group: &'static str, doc: &'static str, kind: Kind, default: [f64; LEVELS]) -> Param {
    Param::list("", "level", kind, default).group(group).doc(doc).source(SOURCE)
}

/// A vector, without its name.
pub(super) fn vector(group: &'static str, doc: &'static str, kind: Kind, default: [f64; 3]) -> Param {
    Param::vector("", kind, default).group(group).doc(doc).source(SOURCE)
}

/// The name of a row: the field's, unless it says another.
macro_rules! name {
    ($field:ident) => {
        stringify!($field)
    };
    ($field:ident $name:literal) => {
        $name
    };
}

/// Declares all parameters of the model. A row is
///
/// ```text
/// field = "name": type [reader] when active => declaration;
/// ```
///
/// where the name is left out if the field is called by it, `reader` makes the field of the numbers
/// in the file, `active` tells of `Facts` whether the numbers matter, and `declaration` is all the
/// rest. Rows of `tree` are fields of `Model`, those of `level` of `Level`. From the same rows follow
/// the parameter space, the order in which values are read, and `Id`.
macro_rules! parameters {
    (
        tree { $($f1:ident $(= $n1:literal)?: $t1:ty [$r1:expr] when $a1:expr => $d1:expr;)* }
        level { $($f2:ident $(= $n2:literal)?: $t2:ty [$r2:expr] when $a2:expr => $d2:expr;)* }
        tree { $($f3:ident $(= $n3:literal)?: $t3:ty [$r3:expr] when $a3:expr => $d3:expr;)* }
    ) => {
        /// The parameters of one level; angles in radians.
        #[derive(Clone, Copy, Debug, Default)]
        pub(crate) struct Level {
            $(pub(crate) $f2: $t2,)*
        }

        /// Checked parameters in the units and groups that growing needs.
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct Model {
            $(pub(crate) $f1: $t1,)*
            pub(crate) levels: [Level; super::LEVELS],
            $(pub(crate) $f3: $t3,)*
        }

        impl Model {
            /// Reads values that [`super::space`] has checked.
            pub(crate) fn new(values: &[f64]) -> Self {
                let mut rest = values;
                // In the order of the rows, which is the order of the values.
                $(let $f1 = $r1(super::read::next(&mut rest));)*
                let mut levels = [Level::default(); super::LEVELS];
                $(
                    let numbers: [f64; super::LEVELS] = super::read::next(&mut rest);
                    for (level, number) in levels.iter_mut().zip(numbers) {
                        level.$f2 = $r2(number);
                    }
                )*
                $(let $f3 = $r3(super::read::next(&mut rest));)*
                Self { $($f1,)* levels, $($f3,)* }
            }
        }

        /// A parameter, by the field that it fills.
        #[allow(non_camel_case_types, dead_code, reason = "one for each field, called as it is")]
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Id {
            $($f1,)* $($f2,)* $($f3,)*
        }

        #[cfg(test)]
        impl Id {
            /// All of them, in order of declaration.
            pub(crate) const ALL: &[Self] =
                &[$(Self::$f1,)* $(Self::$f2,)* $(Self::$f3,)*];
        }

        /// For each parameter, whether its number at an index matters.
        pub(super) const ACTIVE: &[fn(&super::active::Facts) -> bool] = &[$($a1,)* $($a2,)* $($a3,)*];

        /// The declarations in order.
        pub(super) fn params() -> Vec<pleach_tree::Param> {
            let rows = [
                $((super::declare::name!($f1 $($n1)?), $d1),)*
                $((super::declare::name!($f2 $($n2)?), $d2),)*
                $((super::declare::name!($f3 $($n3)?), $d3),)*
            ];
            rows.into_iter().map(|(name, param)| pleach_tree::Param { name: name.into(), ..param }).collect()
        }
    };
}

pub(super) use {name, parameters};
