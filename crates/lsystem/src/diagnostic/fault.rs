//! What can be wrong with a grammar, as facts.

use pleach_tree::param::{DeclarationError, shown};
use std::fmt;

/// What is wrong at one place. [`fmt::Display`] makes a sentence; [`Fault::help`] says what would be
/// right.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// Something else was expected.
    Expected {
        /// What.
        expected: &'static str,
        /// What stands there.
        found: String,
    },
    /// The text is longer than allowed.
    TooLarge {
        /// Its bytes.
        bytes: usize,
        /// Most bytes.
        limit: usize,
    },
    /// Brackets or parentheses in too many layers.
    TooDeep {
        /// Most layers.
        limit: usize,
    },
    /// More of something than allowed.
    TooMany {
        /// Of what.
        what: &'static str,
        /// Most of them.
        limit: usize,
    },
    /// A bracket that nothing closes.
    Unclosed {
        /// The bracket.
        open: char,
        /// What would close it.
        close: char,
    },
    /// A bracket that closes nothing.
    Unopened {
        /// The bracket.
        close: char,
    },
    /// A name that nothing has.
    Unknown {
        /// What kind of name.
        what: &'static str,
        /// The name.
        name: String,
        /// The nearest name that something has.
        nearest: Option<String>,
    },
    /// A name that has a meaning already.
    Reserved {
        /// The name.
        name: String,
    },
    /// Said twice.
    Duplicate {
        /// The name.
        name: String,
    },
    /// A character that is not a symbol.
    NotASymbol {
        /// The character.
        found: char,
    },
    /// The wrong number of arguments.
    Arguments {
        /// Of what.
        name: String,
        /// How many were given.
        found: usize,
        /// Fewest.
        min: usize,
        /// Most.
        max: usize,
    },
    /// A number outside its range.
    OutOfRange {
        /// Of what.
        name: String,
        /// The number.
        value: f64,
        /// Smallest allowed.
        min: f64,
        /// Largest allowed.
        max: f64,
    },
    /// A range whose end is not above its start.
    EmptyRange {
        /// Start.
        min: f64,
        /// End.
        max: f64,
    },
    /// Probabilities that do not sum to one.
    ProbabilitySum {
        /// Their sum.
        sum: f64,
    },
    /// Several successors and one without a probability.
    NoProbability,
    /// Draws where the value has to be the same for every plant.
    DrawsHere,
    /// A parameter that is called as a key of species files is.
    FileKey {
        /// The name.
        name: String,
    },
    /// A parameter whose declaration contradicts itself.
    Declaration(DeclarationError),
    /// A rule that an earlier one hides.
    Hidden {
        /// The rule.
        rule: String,
    },
    /// There is no axiom.
    NoAxiom,
    /// A division by zero while growing.
    DivisionByZero {
        /// The rule, or what else was computed.
        rule: String,
    },
    /// A result that is infinite or not a number.
    NotFinite {
        /// The rule, or what else was computed.
        rule: String,
        /// The result.
        value: f64,
    },
    /// A repetition that goes on for too long.
    TooManyRepeats {
        /// The rule.
        rule: String,
        /// How many repeats it asks for.
        count: f64,
        /// Most repeats.
        limit: usize,
    },
    /// The string grows beyond the limit.
    TooManySymbols {
        /// The rule that writes most.
        rule: String,
        /// Most symbols.
        limit: usize,
    },
    /// Growing takes more work than allowed.
    TooMuchWork {
        /// Most steps of work.
        limit: u64,
    },
    /// A symbol without a rule and without a meaning to the turtle. A warning.
    NoMeaning {
        /// The symbol.
        name: String,
        /// Numbers of arguments for which there are rules.
        ruled: Vec<usize>,
        /// Number of arguments here.
        found: usize,
    },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Expected { expected, found } => write!(f, "expected {expected}, found {found}"),
            Self::TooLarge { bytes, limit } => {
                write!(f, "the grammar has {bytes} bytes or more, at most {limit} are allowed")
            }
            Self::TooDeep { limit } => write!(f, "brackets are nested more than {limit} deep"),
            Self::TooMany { what, limit } => write!(f, "there are more than {limit} {what}"),
            Self::Unclosed { open, close } => write!(f, "`{open}` is not closed: there is no `{close}`"),
            Self::Unopened { close } => write!(f, "`{close}` closes nothing"),
            Self::Unknown { what, name, .. } => write!(f, "`{}` is not a known {what}", shown(name)),
            Self::Reserved { name } => write!(f, "`{}` is taken and cannot be a name", shown(name)),
            Self::Duplicate { name } => write!(f, "`{}` is said twice", shown(name)),
            Self::NotASymbol { found } => write!(f, "`{}` is not a symbol", shown(&found.to_string())),
            Self::Arguments { name, found, min, max } => {
                let plural = if *found == 1 { "" } else { "s" };
                write!(f, "`{}` has {found} argument{plural}, expected {min}", shown(name))?;
                if max > min { write!(f, " to {max}") } else { Ok(()) }
            }
            Self::OutOfRange { name, value, min, max } => {
                write!(f, "`{}` is {value}, which is out of range: allowed is {min} to {max}", shown(name))
            }
            Self::EmptyRange { min, max } => write!(f, "the range {min}..{max} is empty"),
            Self::ProbabilitySum { sum } => {
                write!(f, "the probabilities sum to {}, expected 1", (sum * 1e6).round() / 1e6)
            }
            Self::NoProbability => write!(f, "a rule with several successors needs a probability for each"),
            Self::DrawsHere => write!(f, "a random draw is not allowed here"),
            Self::FileKey { name } => {
                write!(f, "a parameter cannot be called `{}`, which is a key of species files", shown(name))
            }
            Self::Declaration(error) => write!(f, "{error}"),
            Self::Hidden { rule } => {
                write!(f, "this rule never applies: an earlier rule for {rule} comes first")
            }
            Self::NoAxiom => write!(f, "the grammar has no axiom"),
            Self::DivisionByZero { rule } => write!(f, "division by zero in {rule}"),
            Self::NotFinite { rule, value } => {
                write!(f, "a number in {rule} is {value}, which is not finite")
            }
            Self::TooManyRepeats { rule, count, limit } => {
                write!(f, "{rule} repeats {count} times, at most {limit} are allowed")
            }
            Self::TooManySymbols { rule, limit } => {
                write!(f, "the string has more than {limit} symbols, most of them from {rule}")
            }
            Self::TooMuchWork { limit } => write!(f, "growing takes more than {limit} steps of work"),
            Self::NoMeaning { name, ruled, found } if !ruled.is_empty() => {
                let counts: Vec<String> = ruled.iter().map(ToString::to_string).collect();
                write!(f, "no rule takes `{name}` with {found} arguments, only with {}", counts.join(" or "))
            }
            Self::NoMeaning { name, .. } => write!(f, "`{name}` has no rule and no meaning to the turtle"),
        }
    }
}

impl Fault {
    /// Whether the grammar can be used all the same.
    #[must_use]
    pub const fn is_warning(&self) -> bool {
        matches!(self, Self::NoMeaning { .. })
    }

    /// How to mend it, if the fault itself does not say.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        let fixed = match self {
            Self::Unknown { nearest: Some(nearest), .. } => {
                return Some(format!("did you mean `{nearest}`?"));
            }
            Self::Unknown { what: "name", .. } => {
                "declare it: `param x = 1 in 0..2`, `const x = 1`, `let x = 1;` or as a parameter of the rule"
            }
            Self::TooDeep { .. } => "use a rule of its own for the inner part",
            Self::Unclosed { .. } => "brackets pair up within one successor",
            Self::NotASymbol { .. } => "symbols are letters and + - & ^ / \\ | ! ' . ~ $ % [ ] { }",
            Self::ProbabilitySum { .. } => "as in `F -0.4-> FF -0.6-> F`",
            Self::NoProbability => "write `-0.5->` in place of `->`",
            Self::NoAxiom => "begin with a line such as `axiom: F`",
            Self::DrawsHere => "draw once per plant with `const x = rand(0, 1)` and use `x`",
            Self::Hidden { .. } => "give the first one a condition, or both a probability",
            Self::TooManySymbols { .. } | Self::TooMuchWork { .. } => {
                "fewer `steps`, or a condition that ends the growth"
            }
            Self::Reserved { .. } => "keywords and functions cannot be names",
            _ => return None,
        };
        Some(fixed.to_owned())
    }
}
