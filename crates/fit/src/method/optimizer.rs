//! The list of optimisers: name, settings and state of each.

use super::{
    Cma, CmaSettings, Evolution, EvolutionSettings, Hewitt, HewittSettings, Method, MethodSettings, Random,
    RandomSettings, Shade, ShadeSettings, Start,
};
use crate::problem::{Genome, Score};
use crate::space::SearchSpace;
use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// Makes [`Optimizer`], [`AnyMethod`] and all that goes through the list of them. A row is the name on the
/// command line and in files, the variant, the state and the settings.
macro_rules! optimizers {
    ($($name:tt: $variant:ident = $method:ident with $settings:ident,)*) => {
        /// Which optimiser, with its settings.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        pub enum Optimizer {
            $(#[doc = concat!("[`", stringify!($method), "`].")]
            #[serde(rename = $name)]
            $variant($settings),)*
        }

        /// The state of any of the optimisers.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        pub enum AnyMethod {
            $(#[doc = concat!("[`", stringify!($method), "`].")]
            $variant($method),)*
        }

        impl Optimizer {
            /// The names of all optimisers, the default first.
            pub const NAMES: [&'static str; [$($name),*].len()] = [$($name),*];

            /// The name on the command line.
            #[must_use]
            pub const fn name(&self) -> &'static str {
                match self {
                    $(Self::$variant(_) => $name,)*
                }
            }

            /// The optimiser at its beginning.
            #[must_use]
            pub fn method(&self, seed: u64, start: Start) -> AnyMethod {
                match self {
                    $(Self::$variant(settings) => AnyMethod::$variant(settings.begin(seed, start)),)*
                }
            }

            /// Whether `method` was begun by this optimiser with this seed and this start.
            pub(crate) fn has_begun(&self, method: &AnyMethod, seed: u64, start: &Start) -> bool {
                match (self, method) {
                    $((Self::$variant(settings), AnyMethod::$variant(method)) => {
                        settings.has_begun(method, seed, start)
                    })*
                    _ => false,
                }
            }

            /// Whether it wants trees resized to the goal's height before they are compared: see
            /// [`crate::Evaluator::with_height_matching`]. The dissertation's algorithm and the random floor do
            /// not.
            #[must_use]
            pub fn matches_height(&self) -> bool {
                match self {
                    $(Self::$variant(settings) => settings.matches_height(),)*
                }
            }

            /// Whether it searches what is [plausible](pleach_tree::Param::plausible) only, and not all
            /// of the search ranges. The dissertation's algorithm and the random floor do not.
            pub(crate) fn keeps_to_plausible(&self) -> bool {
                match self {
                    $(Self::$variant(settings) => settings.keeps_to_plausible(),)*
                }
            }

            /// Weight of the prior around the start: see [`SearchSpace::with_prior`].
            pub(crate) fn prior(&self) -> f64 {
                match self {
                    $(Self::$variant(settings) => settings.prior(),)*
                }
            }
        }

        impl FromStr for Optimizer {
            type Err = UnknownOptimizer;

            fn from_str(given: &str) -> Result<Self, Self::Err> {
                match given {
                    $($name => Ok(Self::$variant($settings::default())),)*
                    _ => Err(UnknownOptimizer { given: given.to_owned() }),
                }
            }
        }

        impl Method for AnyMethod {
            fn name(&self) -> &'static str {
                match self {
                    $(Self::$variant(method) => method.name(),)*
                }
            }

            fn max_staleness(&self) -> usize {
                match self {
                    $(Self::$variant(method) => method.max_staleness(),)*
                }
            }

            fn ask(&mut self, space: &SearchSpace, members: &mut Vec<Genome>) {
                match self {
                    $(Self::$variant(method) => method.ask(space, members),)*
                }
            }

            fn tell(&mut self, space: &SearchSpace, members: &[Genome], scores: &[Score]) {
                match self {
                    $(Self::$variant(method) => method.tell(space, members, scores),)*
                }
            }

            fn ends_generation(&self) -> bool {
                match self {
                    $(Self::$variant(method) => method.ends_generation(),)*
                }
            }

            fn suits(&self, space: &SearchSpace, generations: u64, pending: &[usize]) -> bool {
                match self {
                    $(Self::$variant(method) => method.suits(space, generations, pending),)*
                }
            }
        }
    };
}

optimizers! {
    "evolution": Evolution = Evolution with EvolutionSettings,
    "cma": Cma = Cma with CmaSettings,
    "de": De = Shade with ShadeSettings,
    "hewitt": Hewitt = Hewitt with HewittSettings,
    "random": Random = Random with RandomSettings,
}

/// An unknown name of an optimiser.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown optimizer `{given}`, known are {}", Optimizer::NAMES.join(", "))]
pub struct UnknownOptimizer {
    /// What was given.
    pub given: String,
}

impl MethodSettings for Optimizer {
    type Method = AnyMethod;

    fn begin(&self, seed: u64, start: Start) -> AnyMethod {
        self.method(seed, start)
    }

    fn has_begun(&self, method: &AnyMethod, seed: u64, start: &Start) -> bool {
        Self::has_begun(self, method, seed, start)
    }
}

impl Default for Optimizer {
    fn default() -> Self {
        Self::Evolution(EvolutionSettings::default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_and_others_are_told_which_there_are() {
        for name in Optimizer::NAMES {
            let optimizer: Optimizer = name.parse().unwrap();
            assert_eq!(optimizer.name(), name);
            assert_eq!(optimizer.method(1, Start::Random).name(), name);
            // As files have it.
            assert!(serde_json::to_value(&optimizer).unwrap()[name].is_object());
        }
        assert_eq!(Optimizer::default().name(), Optimizer::NAMES[0]);
        let message = "cmaes".parse::<Optimizer>().unwrap_err().to_string();
        assert!(message.starts_with("unknown optimizer `cmaes`, known are "), "{message}");
    }

    #[test]
    fn a_state_belongs_to_its_optimizer_seed_and_start() {
        let (one, other): (Optimizer, Optimizer) = ("hewitt".parse().unwrap(), "random".parse().unwrap());
        let state = one.method(1, Start::Random);
        assert!(one.has_begun(&state, 1, &Start::Random));
        assert!(!one.has_begun(&state, 2, &Start::Random));
        assert!(!one.has_begun(&state, 1, &Start::Lists(Vec::new())));
        assert!(!other.has_begun(&state, 1, &Start::Random));
        let larger = Optimizer::Hewitt(HewittSettings { population: 21, ..HewittSettings::default() });
        assert!(!larger.has_begun(&state, 1, &Start::Random));
    }
}
