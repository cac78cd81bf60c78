//! From the syntax tree to the compact form.

use super::scope::Scope;
use super::{Act, Block, Code, Command, Kind, KindIndex, OPS_PER_WORK, Program};
use crate::diagnostic::{Diagnostic, Fault};
use crate::syntax::{Expr, Grammar, Item, Name, Span, Values};
use std::collections::{HashMap, HashSet};

/// Most kinds of modules.
const MAX_KINDS: usize = 4096;

/// Compiles `grammar`. The program can be used if no problem is more than a warning.
pub(crate) fn compile(grammar: &Grammar) -> (Program, Vec<Diagnostic>) {
    let mut problems = Vec::new();
    let mut compiler = Compiler {
        grammar,
        numbers: HashMap::new(),
        uses: Vec::new(),
        sealed: 0,
        ops: 0,
        settled: HashSet::new(),
        program: Program {
            dialect: grammar.dialect,
            params: grammar.params.clone(),
            kinds: Vec::new(),
            rules: Vec::new(),
            acts: Vec::new(),
            runs: Vec::new(),
            codes: Vec::new(),
            ops: Vec::new(),
            spans: Vec::new(),
            axiom: Block { start: 0, end: 0, toll: 0 },
            consts: Vec::new(),
            settings: Vec::new(),
            ignored: Vec::new(),
            random: false,
            waits: false,
            has_context: false,
            locals: 0,
            stack: 1,
        },
    };
    for sign in ["[", "]", "{", "}"] {
        let name = Name { text: sign.to_owned(), span: Span::default() };
        compiler.kind(&name, 0, &mut problems);
    }
    let globals = compiler.header(&mut problems);
    let mut scope = Scope::new(&globals, &mut problems);
    compiler.program.axiom = compiler.block(&grammar.axiom, &mut scope);
    let locals = scope.most;
    compiler.program.locals = locals;
    for rule in &grammar.rules {
        compiler.rule(rule, &globals, &mut problems);
    }
    compiler.finish(&mut problems);
    (compiler.program, problems)
}

pub(super) struct Compiler<'a> {
    grammar: &'a Grammar,
    numbers: HashMap<(String, usize), KindIndex>,
    /// Where each kind is written first.
    uses: Vec<Option<Span>>,
    /// Acts before this one are of repetitions that ended, or of other blocks.
    sealed: usize,
    /// Operations of the expressions of the block that is compiled, without those of blocks within it.
    ops: u32,
    /// Kinds with a rule that always applies, which hides those after it.
    pub(super) settled: HashSet<KindIndex>,
    pub(super) program: Program,
}

impl Compiler<'_> {
    /// The number of a symbol with this many arguments.
    pub(super) fn kind(&mut self, name: &Name, arity: usize, problems: &mut Vec<Diagnostic>) -> KindIndex {
        if let Some(&index) = self.numbers.get(&(name.text.clone(), arity)) {
            return index;
        }
        if self.program.kinds.len() == MAX_KINDS {
            let fault = Fault::TooMany { what: "kinds of modules", limit: MAX_KINDS };
            problems.push(Diagnostic::new(name.span, fault));
            return 0;
        }
        let index = self.program.kinds.len() as KindIndex;
        self.numbers.insert((name.text.clone(), arity), index);
        let declared = self.grammar.modules.iter().find(|m| m.name.text == name.text);
        let symbol = declared.map_or(Some(name.text.as_str()), |m| Some(m.alias.as_ref()?.text.as_str()));
        let command = symbol.map_or(Command::None, |s| match s {
            "{" => Command::OpenPolygon,
            "}" => Command::ClosePolygon,
            s => Command::new(self.program.dialect, s),
        });
        let kind = Kind {
            name: name.text.clone(),
            arity,
            command,
            rules: Vec::new(),
            keyed: false,
            run: None,
            min_len: 1,
        };
        self.program.kinds.push(kind);
        self.uses.push(None);
        index
    }

    /// Compiles parameters, constants and settings; returns the names that all rules know.
    fn header(&mut self, problems: &mut Vec<Diagnostic>) -> Vec<String> {
        let grammar = self.grammar;
        let mut globals: Vec<String> = Vec::new();
        for param in &grammar.params {
            if globals.contains(&param.name.text) {
                let fault = Fault::Duplicate { name: param.name.text.clone() };
                problems.push(Diagnostic::new(param.name.span, fault));
            }
            globals.push(param.name.text.clone());
        }
        for constant in &grammar.consts {
            // A constant knows those before it.
            let mut scope = Scope::new(&globals, problems);
            let code = self.program.expr(&constant.value, &mut scope);
            self.program.consts.push(code);
            if globals.contains(&constant.name.text) {
                let fault = Fault::Duplicate { name: constant.name.text.clone() };
                problems.push(Diagnostic::new(constant.name.span, fault));
            }
            globals.push(constant.name.text.clone());
        }
        for setting in &grammar.settings {
            let mut codes = Vec::new();
            for value in &setting.values {
                let mut scope = Scope::new(&globals, problems).with_words(setting.key);
                let code = self.program.expr(value, &mut scope);
                if self.program.draws(code) {
                    problems.push(Diagnostic::new(value.span, Fault::DrawsHere));
                }
                codes.push(code);
            }
            self.program.settings.push((setting.key, codes));
        }
        globals
    }

    /// Compiles the items of a block, whose local names go out of sight at its end.
    pub(super) fn block(&mut self, items: &[Item], scope: &mut Scope<'_>) -> Block {
        let start = self.program.acts.len() as u32;
        self.sealed = start as usize;
        let before = std::mem::take(&mut self.ops);
        let mut position = 0;
        let (locals, site) = (scope.len(), scope.site);
        scope.site = 0;
        self.items(items, scope, &mut position);
        scope.truncate(locals);
        scope.site = site;
        let ops = std::mem::replace(&mut self.ops, before);
        Block { start, end: self.program.acts.len() as u32, toll: ops / OPS_PER_WORK }
    }

    fn items(&mut self, items: &[Item], scope: &mut Scope<'_>, position: &mut u32) {
        for item in items {
            match item {
                Item::Module { name, args } => {
                    let kind = self.kind(name, args.len(), scope.problems);
                    self.uses[usize::from(kind)].get_or_insert(name.span);
                    if args.is_empty() {
                        self.symbol(kind, position);
                        continue;
                    }
                    let args = self.codes(args, scope);
                    self.program.acts.push(Act::Module { kind, args, position: *position });
                    *position += 1;
                }
                Item::Branch(inside) => self.group(super::OPEN, inside, super::CLOSE, scope, position),
                Item::Polygon(inside) => {
                    self.group(super::OPEN_POLYGON, inside, super::CLOSE_POLYGON, scope, position);
                }
                Item::Let { name, value } => {
                    let code = self.codes(std::slice::from_ref(value), scope);
                    let local = scope.add(name);
                    self.program.acts.push(Act::Let { local, value: code });
                }
                Item::For { name, values, body } => self.repetition(name, values, body, scope),
            }
        }
    }

    fn group(
        &mut self,
        open: KindIndex,
        inside: &[Item],
        close: KindIndex,
        scope: &mut Scope<'_>,
        position: &mut u32,
    ) {
        self.symbol(open, position);
        self.items(inside, scope, position);
        self.symbol(close, position);
    }

    fn repetition(&mut self, name: &Name, values: &Values, body: &[Item], scope: &mut Scope<'_>) {
        let act = self.program.acts.len();
        let site = scope.site;
        scope.site += 1;
        let (first, count) = match values {
            Values::Range(from, to) => (self.codes(&[from.clone(), to.clone()], scope), None),
            Values::List(values) => (self.codes(values, scope), Some(values.len() as u32)),
        };
        let before = scope.len();
        let local = scope.add(name);
        let hole = match count {
            None => Act::Range { local, from: first, to: first + 1, end: 0, toll: 0, site },
            Some(count) => Act::List { local, first, count, end: 0, toll: 0, site },
        };
        self.program.acts.push(hole);
        let block = self.block(body, scope);
        scope.truncate(before);
        if let Act::Range { end, toll, .. } | Act::List { end, toll, .. } = &mut self.program.acts[act] {
            (*end, *toll) = (block.end, block.toll);
        }
        self.sealed = block.end as usize;
    }

    /// Appends a symbol without arguments to the run that stands last, or to a new one.
    fn symbol(&mut self, kind: KindIndex, position: &mut u32) {
        let at = self.program.runs.len() as u32;
        self.program.runs.push(kind);
        let is_open = self.program.acts.len() > self.sealed;
        match self.program.acts.last_mut() {
            Some(Act::Run { start, len, .. }) if is_open && *start + *len == at => *len += 1,
            _ => self.program.acts.push(Act::Run { start: at, len: 1, position: *position }),
        }
        *position += 1;
    }

    /// Compiles expressions one after the other; returns the number of the first.
    fn codes(&mut self, exprs: &[Expr], scope: &mut Scope<'_>) -> u32 {
        let codes: Vec<Code> = exprs.iter().map(|expr| self.program.expr(expr, scope)).collect();
        self.ops += codes.iter().map(|code| code.end - code.start).sum::<u32>();
        let first = self.program.codes.len() as u32;
        self.program.codes.extend(codes);
        first
    }

    /// Symbols that nothing gives a meaning, and what follows from all rules together.
    fn finish(&mut self, problems: &mut Vec<Diagnostic>) {
        let program = &self.program;
        for (kind, span) in program.kinds.iter().zip(&self.uses) {
            let Some(span) = span.as_ref().filter(|_| kind.rules.is_empty() && kind.command == Command::None)
            else {
                continue;
            };
            let others = program.kinds.iter().filter(|k| k.name == kind.name && !k.rules.is_empty());
            let ruled: Vec<usize> = others.map(|k| k.arity).collect();
            if ruled.is_empty() && !kind.name.starts_with(|c: char| c.is_ascii_alphabetic()) {
                continue;
            }
            let fault = Fault::NoMeaning { name: kind.name.clone(), ruled, found: kind.arity };
            problems.push(Diagnostic::new(*span, fault));
        }
        let ignore: HashSet<&str> = self.grammar.ignore.iter().map(|name| name.text.as_str()).collect();
        self.program.ignored =
            self.program.kinds.iter().map(|kind| ignore.contains(kind.name.as_str())).collect();
        self.program.settle();
    }
}
