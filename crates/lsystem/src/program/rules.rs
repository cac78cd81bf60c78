//! Rules, and what follows from all of them together.

use super::compile::Compiler;
use super::scope::Scope;
use super::{Act, Block, Code, Command, Formal, Kind, KindIndex, OPS_PER_WORK, Op, Pattern, Program, Rule};
use crate::derive::Machine;
use crate::diagnostic::{Diagnostic, Fault};
use crate::syntax::{self, Context, Predecessor};

/// How far probabilities may miss a sum of 1.
pub(crate) const SUM_TOLERANCE: f64 = 1e-6;

impl Compiler<'_> {
    pub(super) fn rule(&mut self, rule: &syntax::Rule, globals: &[String], problems: &mut Vec<Diagnostic>) {
        let mut scope = Scope::new(globals, problems);
        let pred = self.formal(&rule.pred, &mut scope);
        let left: Vec<Formal> = rule.left.iter().map(|m| self.formal(m, &mut scope)).collect();
        let right = self.patterns(&rule.right, &mut scope);
        let condition = rule.condition.as_ref().map(|c| self.program.expr(c, &mut scope));
        let mut weights = Vec::new();
        if rule.successors.len() > 1 || rule.successors[0].weight.is_some() {
            for successor in &rule.successors {
                match &successor.weight {
                    Some(weight) => weights.push(self.program.expr(weight, &mut scope)),
                    None => scope.problem(rule.span, Fault::NoProbability),
                }
            }
        }
        self.check_weights(rule, &weights, &mut scope);
        let successors: Vec<Block> =
            rule.successors.iter().map(|s| self.block(&s.items, &mut scope)).collect();
        self.program.locals = self.program.locals.max(scope.most);
        let kind = usize::from(pred.kind);
        let number = self.program.rules.len();
        if self.settled.contains(&pred.kind) {
            problems.push(Diagnostic::new(rule.span, Fault::Hidden { rule: rule.pred.to_string() }));
        }
        if condition.is_none() && left.is_empty() && right.is_empty() {
            self.settled.insert(pred.kind);
        }
        let ops: u32 = condition.iter().chain(&weights).map(|code| code.end - code.start).sum();
        let toll = ops / OPS_PER_WORK;
        if matches!(rule.pred.name.text.as_str(), "[" | "]" | "{" | "}") {
            let fault = Fault::Reserved { name: rule.pred.name.text.clone() };
            problems.push(Diagnostic::new(rule.pred.name.span, fault));
        }
        self.program.kinds[kind].rules.push(number);
        self.program.has_context |= !(left.is_empty() && right.is_empty());
        let (name, span) = (rule.head(), rule.span);
        self.program.rules.push(Rule { name, span, left, right, condition, weights, toll, successors });
    }

    fn formal(&mut self, module: &Predecessor, scope: &mut Scope<'_>) -> Formal {
        let kind = self.kind(&module.name, module.params.len(), scope.problems);
        let local = scope.len() as u16;
        for param in &module.params {
            scope.add(param);
        }
        Formal { kind, local }
    }

    fn patterns(&mut self, parts: &[Context], scope: &mut Scope<'_>) -> Vec<Pattern> {
        parts
            .iter()
            .map(|part| match part {
                Context::Module(module) => Pattern::Module(self.formal(module, scope)),
                Context::Branch(inside) => Pattern::Branch(self.patterns(inside, scope)),
            })
            .collect()
    }

    /// Probabilities that are plain numbers are summed here, others at each step.
    fn check_weights(&mut self, rule: &syntax::Rule, weights: &[Code], scope: &mut Scope<'_>) {
        let known = weights.iter().all(|&w| self.program.is_constant(w));
        if weights.is_empty() || !known || weights.len() < rule.successors.len() {
            return;
        }
        let mut machine = Machine::new(&self.program);
        let mut sum = 0.0;
        for (&weight, successor) in weights.iter().zip(&rule.successors) {
            let span = successor.weight.as_ref().map_or(rule.span, |w| w.span);
            match machine.eval(weight) {
                Ok(value) if (0.0..=1.0).contains(&value) => sum += value,
                Ok(value) => {
                    let name = "the probability".to_owned();
                    scope.problem(span, Fault::OutOfRange { name, value, min: 0.0, max: 1.0 });
                    return;
                }
                Err(trouble) => return scope.problem(span, trouble.fault(&rule.head())),
            }
        }
        if (sum - 1.0).abs() > SUM_TOLERANCE {
            scope.problem(rule.span, Fault::ProbabilitySum { sum });
        }
    }
}

impl Program {
    /// What follows from all rules: which kinds need addresses, and how many modules follow on each.
    pub(super) fn settle(&mut self) {
        let draws_in = |block: &Block| {
            let acts = &self.acts[block.start as usize..block.end as usize];
            acts.iter().any(|act| self.act_draws(act))
        };
        let random_rule: Vec<bool> = self
            .rules
            .iter()
            .map(|rule| {
                rule.weights.len() > 1
                    || rule.condition.is_some_and(|c| self.draws(c))
                    || rule.successors.iter().any(draws_in)
            })
            .collect();
        let bends = self.settings.iter().any(|(key, _)| *key == syntax::SettingKey::Bendiness);
        let mut keyed: Vec<bool> = self
            .kinds
            .iter()
            .map(|kind| {
                kind.rules.iter().any(|&r| random_rule[r]) || bends && kind.command == Command::Forward
            })
            .collect();
        // A kind whose successors need addresses needs one itself, and so on up.
        let mut writers = vec![Vec::new(); self.kinds.len()];
        for (number, kind) in self.kinds.iter().enumerate() {
            for &block in kind.rules.iter().flat_map(|&r| &self.rules[r].successors) {
                self.kinds_in(block).for_each(|written| writers[usize::from(written)].push(number));
            }
        }
        let mut waiting: Vec<usize> = (0..keyed.len()).filter(|&number| keyed[number]).collect();
        while let Some(number) = waiting.pop() {
            for &writer in &writers[number] {
                if !std::mem::replace(&mut keyed[writer], true) {
                    waiting.push(writer);
                }
            }
        }
        self.waits = self.rules.iter().any(|rule| rule.condition.is_some_and(|c| self.draws(c)));
        self.random = keyed.iter().any(|&k| k);
        for (number, keyed) in keyed.into_iter().enumerate() {
            let (run, min_len) = self.fixed(number);
            let kind = &mut self.kinds[number];
            (kind.keyed, kind.run, kind.min_len) = (keyed, run, min_len);
        }
    }

    /// The rules that write most modules of the kinds that `is_meant` means, as messages call them;
    /// repeats are not counted.
    pub(crate) fn writers(&self, is_meant: impl Fn(&Kind) -> bool) -> Vec<String> {
        /// Most that are named.
        const MAX: usize = 2;
        let count = |rule: &Rule| {
            let written = rule.successors.iter().flat_map(|block| self.kinds_in(*block));
            written.filter(|&kind| is_meant(&self.kinds[usize::from(kind)])).count()
        };
        let mut writers: Vec<(usize, &str)> =
            self.rules.iter().map(|rule| (count(rule), rule.name.as_str())).filter(|w| w.0 > 0).collect();
        writers.sort_by_key(|writer| std::cmp::Reverse(writer.0));
        writers.into_iter().take(MAX).map(|(_, name)| name.to_owned()).collect()
    }

    /// How often the grammar reads the parameter `number`.
    pub(crate) fn reads_of(&self, number: usize) -> usize {
        let is_read = |op: &&Op| matches!(op, Op::Global(i) if usize::from(*i) == number);
        self.ops.iter().filter(is_read).count()
    }

    /// The parameters that a setting is computed from.
    pub(crate) fn params_of(&self, key: syntax::SettingKey) -> Vec<String> {
        let codes = self.settings.iter().filter(|(known, _)| *known == key).flat_map(|(_, codes)| codes);
        let ops = codes.flat_map(|code| &self.ops[code.start as usize..code.end as usize]);
        let globals = ops.filter_map(|op| if let Op::Global(i) = op { Some(usize::from(*i)) } else { None });
        globals.filter_map(|i| Some(self.params.get(i)?.name.text.clone())).collect()
    }

    fn act_draws(&self, act: &Act) -> bool {
        let codes = |first: u32, count: usize| &self.codes[first as usize..first as usize + count];
        let codes = match *act {
            Act::Run { .. } => return false,
            Act::Module { kind, args, .. } => codes(args, self.kinds[usize::from(kind)].arity),
            Act::Let { value, .. } => codes(value, 1),
            Act::Range { from, .. } => codes(from, 2),
            Act::List { first, count, .. } => codes(first, count as usize),
        };
        codes.iter().any(|&code| self.draws(code))
    }

    fn kinds_in(&self, block: Block) -> impl Iterator<Item = KindIndex> + '_ {
        self.acts[block.start as usize..block.end as usize].iter().flat_map(|act| match *act {
            Act::Run { start, len, .. } => self.runs[start as usize..(start + len) as usize].to_vec(),
            Act::Module { kind, .. } => vec![kind],
            _ => Vec::new(),
        })
    }

    /// The run that always replaces a kind, and the fewest modules that it leaves.
    fn fixed(&self, number: usize) -> (Option<(u32, u32)>, u64) {
        let rules = &self.kinds[number].rules;
        let always = |rule: &Rule| rule.condition.is_none() && rule.left.is_empty() && rule.right.is_empty();
        let mut min_len = if rules.iter().any(|&r| always(&self.rules[r])) { u64::MAX } else { 1 };
        for block in rules.iter().flat_map(|&r| &self.rules[r].successors) {
            min_len = min_len.min(self.min_len(*block));
        }
        let run = match rules.first().map(|&r| &self.rules[r]) {
            Some(rule) if always(rule) && rule.weights.len() < 2 => {
                let Block { start, end, .. } = rule.successors[0];
                match (end - start, self.acts.get(start as usize)) {
                    (0, _) => Some((0, 0)),
                    (1, Some(&Act::Run { start, len, .. })) => Some((start, len)),
                    _ => None,
                }
            }
            _ => None,
        };
        (run, min_len)
    }

    /// Modules that a block writes at least: repetitions may be empty.
    fn min_len(&self, block: Block) -> u64 {
        let (mut at, mut sum) = (block.start, 0);
        while at < block.end {
            at += 1;
            match self.acts[at as usize - 1] {
                Act::Run { len, .. } => sum += u64::from(len),
                Act::Module { .. } => sum += 1,
                Act::Range { end, .. } | Act::List { end, .. } => at = end,
                Act::Let { .. } => {}
            }
        }
        sum
    }
}
