//! Grammars as generators of trees.

use crate::derive::{DeriveError, Limits};
use crate::diagnostic::{Diagnostic, Fault, Report};
use crate::program::Command;
use crate::syntax::{ExprKind, Grammar, ParamDecl, ParamUnit, SettingKey};
use crate::system::{Derivation, LSystem};
use crate::turtle::GrowFault;
use pleach_tree::param::{DeclarationError, Effect, Kind, Param, Scale};
use pleach_tree::species::KEYS;
use pleach_tree::{
    Blame, CheckedParams, Generator, GrowError, Growth, ParamSpace, Tree, Unit, Variation, Workspace,
};
use std::sync::Arc;

/// The key of the grammar in species files.
pub(crate) const GRAMMAR: &str = "grammar";

/// The family's name in species files.
pub(crate) const NAME: &str = "lsystem";

/// Longest text of a grammar that evolves, in bytes: some ten screens. Longer ones are refused, so that rules
/// cannot be duplicated without end.
pub(crate) const MAX_TEXT: usize = 20_000;

/// A grammar whose declared parameters are the numbers of a species.
#[derive(Clone, Debug)]
pub struct GrammarGenerator {
    system: Arc<LSystem>,
    space: Arc<ParamSpace>,
    structure: String,
    /// Whether sizes are read nowhere but in `scale`.
    in_proportion: bool,
}

impl GrammarGenerator {
    /// The generator of `system`.
    ///
    /// # Errors
    /// Declarations that contradict themselves, such as a count between two whole numbers.
    pub fn new(system: LSystem) -> Result<Self, DeclarationError> {
        let params = system.params().iter().map(|p| declaration(p, system.grammar())).collect();
        let space = Arc::new(ParamSpace::new(params)?);
        let structure = toml(&system.grammar().to_string());
        let reads = space.sizes().map(|slot| system.program.reads_of(slot.index())).sum::<usize>();
        // Where there is a size, the setting reads it.
        let in_proportion = reads == 1;
        Ok(Self { system: Arc::new(system), space, structure, in_proportion })
    }

    /// The generator of a grammar as species files have it.
    ///
    /// # Errors
    /// What [`LSystem::read`] finds, parameters that are called as keys of species files are, and those of
    /// [`GrammarGenerator::new`], each with its place.
    pub fn read(text: &str) -> Result<Self, Report> {
        let system = LSystem::read(GRAMMAR, text)?;
        let taken = |name: &str| name == GRAMMAR || KEYS.iter().any(|key| key.name == name);
        let names = system.params().iter().map(|param| &param.name);
        let wrong = names.filter(|name| taken(&name.text)).map(|name| {
            let fault = Fault::FileKey { name: name.text.clone() };
            Diagnostic::new(name.span, fault)
        });
        let wrong: Vec<Diagnostic> = wrong.collect();
        if !wrong.is_empty() {
            return Err(Report::new(GRAMMAR, text, wrong));
        }
        let spans: Vec<_> = system.params().iter().map(|param| param.name.clone()).collect();
        Self::new(system).map_err(|error| {
            let name = spans.iter().find(|name| name.text == error.param);
            let span = name.map(|name| name.span).unwrap_or_default();
            Report::new(GRAMMAR, text, vec![Diagnostic::new(span, Fault::Declaration(error))])
        })
    }

    /// The grammar.
    #[must_use]
    pub fn system(&self) -> &LSystem {
        &self.system
    }

    fn error(&self, error: &DeriveError, growth: &Growth) -> GrowError {
        let DeriveError { step, diagnostic, rule } = error;
        match &diagnostic.fault {
            Fault::TooManySymbols { .. } | Fault::TooMuchWork { .. } => {
                let params = self.system.program.params_of(SettingKey::Steps);
                let blame = Blame(rule.iter().cloned().chain(params).collect());
                GrowError::TooMuchWork { limit: growth.limits.work, blame }
            }
            fault => {
                let (line, _) = self.system.report(error).place(diagnostic.span.start);
                GrowError::Rule { line, step: *step, problem: fault.to_string() }
            }
        }
    }
}

/// A parameter of a grammar as species files, searches and blends know it.
fn declaration(param: &ParamDecl, grammar: &Grammar) -> Param {
    let (min, max) = param.range;
    let (low, high) = param.search.unwrap_or(param.range);
    let is_count = param.unit == ParamUnit::Count;
    let kind =
        if is_count { Kind::integer(min.ceil() as i64, max.floor() as i64) } else { Kind::real(min, max) };
    // The factor on the whole tree is its size; lengths of parts are not.
    let is_scale = |s: &crate::syntax::Setting| {
        s.key == SettingKey::Scale
            && matches!(&s.values[0].kind, ExprKind::Name(name) if *name == param.name.text)
    };
    let is_size = grammar.settings.iter().any(is_scale);
    let scale = match () {
        () if is_count => Scale::Count,
        () if is_size && low > 0.0 => Scale::Log,
        () => Scale::Linear,
    };
    let effect = match () {
        () if is_size => Effect::Size,
        () if is_count => Effect::Layout,
        () => Effect::Plain,
    };
    let unit = match param.unit {
        ParamUnit::Meters => Unit::Meters,
        ParamUnit::Degrees => Unit::Degrees,
        ParamUnit::Count => Unit::Count,
        ParamUnit::Ratio => Unit::Ratio,
    };
    Param::scalar(param.name.text.clone(), kind, param.default)
        .search([(low, high)])
        .unit(unit)
        .scale([scale])
        .effect([effect])
        .group("grammar")
        .doc(param.doc.clone())
        .source("the species' grammar")
}

/// The grammar as lines of a species file.
fn toml(grammar: &str) -> String {
    let ending = if grammar.is_empty() || grammar.ends_with('\n') { "" } else { "\n" };
    // As it is where the file can have that: no escapes, no control characters.
    let is_plain =
        !grammar.contains("'''") && grammar.chars().all(|c| !c.is_control() || matches!(c, '\n' | '\t'));
    if is_plain {
        return format!("grammar = '''\n{grammar}{ending}'''\n");
    }
    let mut escaped = String::with_capacity(grammar.len());
    for c in grammar.chars() {
        match c {
            '\\' | '"' => escaped.extend(['\\', c]),
            '\n' | '\t' => escaped.push(c),
            c if c.is_control() => escaped.push_str(&format!("\\u{:04x}", u32::from(c))),
            c => escaped.push(c),
        }
    }
    format!("grammar = \"\"\"\n{escaped}{ending}\"\"\"\n")
}

impl Generator for GrammarGenerator {
    fn family(&self) -> &'static str {
        NAME
    }

    fn space(&self) -> &Arc<ParamSpace> {
        &self.space
    }

    fn structure(&self) -> String {
        self.structure.clone()
    }

    fn written(&self) -> String {
        toml(self.system.text())
    }

    fn variation(&self) -> Option<&dyn Variation> {
        // A search keeps hundreds of copies.
        (self.structure.len() <= MAX_TEXT).then_some(self)
    }

    fn grows_in_proportion(&self) -> bool {
        self.in_proportion
    }

    fn grow(
        &self,
        params: &CheckedParams,
        growth: &Growth,
        _: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(), GrowError> {
        let values = params.values_in(&self.space)?;
        let work = growth.limits.work;
        let symbols = Limits::DEFAULT.symbols.min(usize::try_from(work).unwrap_or(usize::MAX));
        let derivation = Derivation {
            params: Some(values),
            seed: growth.seed,
            steps: None,
            limits: Limits { symbols, work },
            parallel: growth.parallel,
        };
        let derived = self.system.derive(&derivation).map_err(|error| self.error(&error, growth))?;
        let limits = growth.limits;
        let writers = |is_meant: fn(Command, usize) -> bool| {
            Blame(self.system.program.writers(|kind| is_meant(kind.command, kind.arity)))
        };
        let is_leaf = |command, arity| match command {
            Command::Forward => arity > 1,
            command => matches!(command, Command::Leaf | Command::ClosePolygon),
        };
        derived.grow(&limits, growth.foliage, tree).map_err(|fault| match fault {
            GrowFault::Stems => {
                let blame = writers(|command, _| matches!(command, Command::Open | Command::Move));
                GrowError::TooManyStems { limit: limits.stems, blame }
            }
            GrowFault::Knots => {
                let blame = writers(|command, _| command == Command::Forward);
                GrowError::TooManyKnots { limit: limits.knots, blame }
            }
            GrowFault::Leaves => GrowError::TooManyLeaves { limit: limits.leaves, blame: writers(is_leaf) },
            GrowFault::NotFinite => GrowError::NotFinite { what: "a position" },
            GrowFault::NothingDrawn => GrowError::Rule {
                line: 1,
                step: 0,
                problem: "nothing is drawn: the string has no `F`".to_owned(),
            },
        })
    }
}
