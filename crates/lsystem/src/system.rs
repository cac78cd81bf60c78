//! A grammar that is ready to grow.

use crate::derive::{self, DeriveError, Limits, Modules, Request};
use crate::diagnostic::{Diagnostic, Report, place};
use crate::header::Header;
use crate::program::{Program, compile};
use crate::syntax::{Grammar, ParamDecl};
use pleach_tree::Key;
use std::fmt;

/// A grammar, read, checked and compiled.
#[derive(Clone, Debug)]
pub struct LSystem {
    origin: String,
    text: String,
    grammar: Grammar,
    pub(crate) program: Program,
    warnings: Vec<Diagnostic>,
}

/// What to derive.
#[derive(Clone, Copy, Debug, Default)]
pub struct Derivation<'a> {
    /// Values of the declared parameters in their order; their defaults if absent.
    pub params: Option<&'a [f64]>,
    /// Seed of all draws.
    pub seed: u64,
    /// Number of steps; the grammar's own if absent.
    pub steps: Option<usize>,
    /// How large the string may become.
    pub limits: Limits,
    /// Whether long strings are rewritten on rayon's threads. The string is the same.
    pub parallel: bool,
}

/// A derived string.
#[derive(Clone)]
pub struct Derived<'a> {
    pub(crate) system: &'a LSystem,
    pub(crate) modules: Modules,
    pub(crate) key: Key,
    header: Header,
}

impl LSystem {
    /// Reads a grammar; `origin` (a file name) is for messages.
    ///
    /// ```
    /// use pleach_lsystem::LSystem;
    ///
    /// let report = LSystem::read("bad.lsystem", "steps: 3\naxiom: A\nA -> F(\n").unwrap_err();
    /// assert!(report.to_string().contains("bad.lsystem:3"), "{report}");
    /// ```
    ///
    /// # Errors
    /// Every problem that was found, with its place.
    pub fn read(origin: &str, text: &str) -> Result<Self, Report> {
        let text = crate::without_mark(text);
        let (grammar, mut problems) = crate::parse::parse(text);
        let (program, more) = compile(&grammar);
        problems.extend(more);
        if problems.iter().any(|p| !p.fault.is_warning()) {
            // A statement that could not be read makes symbols look as if nothing used them.
            problems.retain(|p| !p.fault.is_warning());
            let text = if text.len() > crate::MAX_BYTES { "" } else { text };
            return Err(Report::new(origin, text, problems));
        }
        let (origin, text) = (origin.to_owned(), text.to_owned());
        Ok(Self { origin, text, grammar, program, warnings: problems })
    }

    /// The syntax tree, which prints in normal form.
    #[must_use]
    pub const fn grammar(&self) -> &Grammar {
        &self.grammar
    }

    /// The text that it was read from.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The declared parameters.
    #[must_use]
    pub fn params(&self) -> &[ParamDecl] {
        &self.program.params
    }

    /// What is odd and not wrong.
    #[must_use]
    pub fn warnings(&self) -> Option<Report> {
        let report = || Report::new(&self.origin, &self.text, self.warnings.clone());
        (!self.warnings.is_empty()).then(report)
    }

    /// Line and column, both from 1, of the first rule or parameter that messages call `name`.
    #[must_use]
    pub fn place_of(&self, name: &str) -> Option<(usize, usize)> {
        let rules = self.program.rules.iter().map(|rule| (rule.name.as_str(), rule.span));
        let params = self.params().iter().map(|param| (param.name.text.as_str(), param.name.span));
        let (_, span) = rules.chain(params).find(|(known, _)| *known == name)?;
        Some(place(&self.text, span.start))
    }

    /// Draws the place of an error that came up while growing.
    #[must_use]
    pub fn report(&self, error: &DeriveError) -> Report {
        Report::new(&self.origin, &self.text, vec![error.diagnostic.clone()])
    }

    /// The string after the steps.
    ///
    /// # Errors
    /// Divisions by zero, numbers that are not finite, probabilities that do not sum to 1, and strings
    /// beyond the limits, each with its rule.
    ///
    /// # Panics
    /// If `derivation.params` has another number of values than the grammar has parameters.
    pub fn derive(&self, derivation: &Derivation<'_>) -> Result<Derived<'_>, DeriveError> {
        let defaults: Vec<f64>;
        let params = if let Some(params) = derivation.params {
            assert_eq!(params.len(), self.params().len(), "one value per declared parameter");
            params
        } else {
            defaults = self.params().iter().map(|p| p.default).collect();
            &defaults
        };
        let key = Key::root(derivation.seed);
        let globals = derive::globals(&self.program, params, key)?;
        let header = Header::new(&self.program, &globals)?;
        let steps = derivation.steps.unwrap_or_else(|| header.steps());
        let Derivation { limits, parallel, .. } = *derivation;
        let request = Request { globals: &globals, key, steps, limits, parallel };
        let modules = derive::derive(&self.program, &request)?;
        Ok(Derived { system: self, modules, key, header })
    }
}

impl fmt::Debug for Derived<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Derived").field("len", &self.len()).finish_non_exhaustive()
    }
}

impl Derived<'_> {
    /// Number of modules, brackets included.
    #[must_use]
    pub fn len(&self) -> usize {
        self.modules.kinds.len()
    }

    /// Whether nothing is left.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.modules.kinds.is_empty()
    }

    /// How many modules have this symbol, with any number of arguments.
    #[must_use]
    pub fn count(&self, symbol: &str) -> usize {
        let kinds = &self.system.program.kinds;
        let matches: Vec<bool> = kinds.iter().map(|k| k.name == symbol).collect();
        self.modules.kinds.iter().filter(|&&k| matches[usize::from(k)]).count()
    }

    /// The symbols with their arguments, in order.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &[f64])> {
        self.modules.iter(&self.system.program.kinds).map(|(kind, values)| (kind.name.as_str(), values))
    }

    /// The string as people write it: `A(2, 0.5)[+F]`.
    #[must_use]
    pub fn to_text(&self) -> String {
        self.modules.to_text(&self.system.program)
    }

    /// The settings of the grammar.
    #[must_use]
    pub const fn header(&self) -> &Header {
        &self.header
    }
}
