//! One derivation step: every module at once.

use super::context::{Place, Surroundings};
use super::machine::{Trouble, purpose};
use super::string::Modules;
use super::writer::{VALUES_PER_MODULE, Writer};
use super::{Limits, NO_RULE, Stop};
use crate::program::{Kind, Program, Rule, SUM_TOLERANCE};
use pleach_tree::Key;
use rayon::prelude::*;

/// Modules that one task rewrites.
const CHUNK: usize = 16_384;
/// Modules from which tasks pay: on busy cores copying their results took longer than they saved.
const MIN_PARALLEL: usize = 4 * CHUNK;
/// Tasks after which limits are looked at: bounds what is written beyond them.
const WAVE: usize = 16;
/// Rules tried for one module that are one more step of work.
const RULES_PER_WORK: usize = 16;
/// Modules passed in search of one context that are one more step of work.
const PASSED_PER_WORK: u64 = 16;

/// What all modules of a step share.
#[derive(Clone, Copy)]
pub(super) struct Step<'a> {
    pub(super) program: &'a Program,
    pub(super) globals: &'a [f64],
    pub(super) string: &'a Modules,
    pub(super) number: u32,
    pub(super) limits: Limits,
    /// Work of the steps before this one.
    pub(super) spent: u64,
    pub(super) surroundings: Option<&'a Surroundings>,
}

/// A run of modules and the first of their arguments.
#[derive(Clone, Copy)]
struct Chunk {
    start: usize,
    end: usize,
    value: usize,
}

/// What became of a run.
struct Written {
    out: Modules,
    changed: bool,
    work: u64,
}

impl Step<'_> {
    /// Fails at once where even the shortest successors are too many; returns how many these are.
    pub(super) fn foresee(&self) -> Result<usize, Stop> {
        let kinds = &self.program.kinds;
        let mut counts = vec![0_u64; kinds.len()];
        for &kind in &self.string.kinds {
            counts[usize::from(kind)] += 1;
        }
        let sizes = || counts.iter().zip(kinds).map(|(&count, kind)| count.saturating_mul(kind.min_len));
        let sum = sizes().fold(0, u64::saturating_add);
        if sum > self.limits.symbols as u64 {
            let most = sizes().enumerate().max_by_key(|&(i, size)| (size, std::cmp::Reverse(i)));
            let rule = most.and_then(|(i, _)| kinds[i].rules.first().copied()).unwrap_or(NO_RULE);
            return Err(Stop { rule, trouble: Trouble::TooManySymbols(self.limits.symbols) });
        }
        Ok(sum as usize)
    }

    /// Rewrites the whole string into `out`; returns whether any rule applied, and the work.
    pub(super) fn rewrite(&self, mut out: Modules, parallel: bool) -> Result<(Modules, bool, u64), Stop> {
        let length = self.foresee()?;
        out.clear();
        if parallel && self.string.kinds.len() > MIN_PARALLEL {
            let mut target = std::mem::take(&mut out);
            if let Some((changed, work)) = self.in_waves(&mut target, length) {
                return Ok((target, changed, work));
            }
            // Something went wrong: what, the modules in their order tell.
            out = target;
            out.clear();
        }
        out.kinds.reserve(length);
        if self.program.random {
            out.keys.reserve(length);
        }
        let whole = Chunk { start: 0, end: self.string.kinds.len(), value: 0 };
        let Written { out, changed, work } = self.rewrite_chunk(whole, out, self.limits.symbols)?;
        Ok((out, changed, work))
    }

    /// `length` is the fewest modules that there will be.
    fn in_waves(&self, out: &mut Modules, length: usize) -> Option<(bool, u64)> {
        out.kinds.reserve(length);
        let part = length / self.string.kinds.len().div_ceil(CHUNK);
        let mut chunks = Vec::new();
        let mut value = 0;
        for (number, kinds) in self.string.kinds.chunks(CHUNK).enumerate() {
            let start = number * CHUNK;
            chunks.push(Chunk { start, end: start + kinds.len(), value });
            value += kinds.iter().map(|&k| self.program.kinds[usize::from(k)].arity).sum::<usize>();
        }
        let (mut changed, mut work) = (false, 0);
        for wave in chunks.chunks(WAVE) {
            let room = self.limits.symbols - out.kinds.len();
            let most_values = self.limits.symbols.saturating_mul(VALUES_PER_MODULE);
            let written: Vec<Result<Written, Stop>> = wave
                .par_iter()
                .map(|&chunk| self.rewrite_chunk(chunk, Modules::with_room(part), room))
                .collect();
            for part in written {
                let part = part.ok()?;
                out.append(&part.out);
                changed |= part.changed;
                work += part.work;
                let too_many = out.kinds.len() > self.limits.symbols || out.values.len() > most_values;
                if too_many || self.spent + work > self.limits.work {
                    return None;
                }
            }
        }
        Some((changed, work))
    }

    fn rewrite_chunk(&self, chunk: Chunk, out: Modules, room: usize) -> Result<Written, Stop> {
        let Self { program, string, .. } = *self;
        let mut writer = Writer::new(program, self.globals, out, room, (self.spent, self.limits.work));
        let (mut changed, mut value) = (false, chunk.value);
        writer.work += (chunk.end - chunk.start) as u64;
        for at in chunk.start..chunk.end {
            let number = string.kinds[at];
            let kind = &program.kinds[usize::from(number)];
            let values = &string.values[value..value + kind.arity];
            value += kind.arity;
            if let Some(run) = kind.run
                && !kind.keyed
            {
                writer.run(run, 0, Key::root(0));
                changed = true;
            } else if !kind.rules.is_empty() && self.apply(kind, at, values, &mut writer)? {
                changed = true;
            } else {
                writer.out.kinds.push(number);
                writer.out.values.extend_from_slice(values);
                if program.random {
                    writer.out.keys.push(string.keys[at]);
                }
            }
            // Rules that did not apply were work too.
            if let Some(&rule) = kind.rules.first() {
                writer.check().map_err(|trouble| Stop { rule, trouble })?;
            }
        }
        writer.check().map_err(|trouble| Stop { rule: NO_RULE, trouble })?;
        let Writer { out, work, .. } = writer;
        Ok(Written { out, changed, work: work - self.spent })
    }

    /// Replaces a module by the successor of the first rule that applies, if one does.
    fn apply(&self, kind: &Kind, at: usize, values: &[f64], writer: &mut Writer<'_>) -> Result<bool, Stop> {
        let program = self.program;
        let base =
            if kind.keyed { self.string.keys[at].child(purpose::STEP, self.number) } else { Key::root(0) };
        writer.machine.frame[..values.len()].copy_from_slice(values);
        for (number, &index) in kind.rules.iter().enumerate() {
            let rule = &program.rules[index];
            let stop = |trouble| Stop { rule: index, trouble };
            // Rules and expressions in such numbers, and contexts so far away, take time of their own.
            writer.work += u64::from(rule.toll) + u64::from(number % RULES_PER_WORK == RULES_PER_WORK - 1);
            if !self.in_context(rule, at, writer) {
                continue;
            }
            let key = if kind.keyed { base.child(purpose::RULE, number as u32) } else { base };
            if let Some(condition) = rule.condition {
                writer.machine.key = key;
                if writer.machine.eval(condition).map_err(stop)? == 0.0 {
                    continue;
                }
            }
            let choice = self.choose(rule, key, writer).map_err(stop)?;
            let key = if kind.keyed { key.child(purpose::SUCCESSOR, choice as u32) } else { key };
            writer.block(rule.successors[choice], key).map_err(stop)?;
            return Ok(true);
        }
        Ok(false)
    }

    fn in_context(&self, rule: &Rule, at: usize, writer: &mut Writer<'_>) -> bool {
        let Some(surroundings) = self.surroundings else { return true };
        if rule.left.is_empty() && rule.right.is_empty() {
            return true;
        }
        let Self { program, string, .. } = *self;
        let frame = &mut writer.machine.frame;
        let mut place = Place { program, string, surroundings, frame, passed: 0 };
        let fits = place.left(at, &rule.left) && place.right(at + 1, &rule.right);
        writer.work += place.passed / PASSED_PER_WORK;
        fits
    }

    /// Draws one of the successors.
    fn choose(&self, rule: &Rule, key: Key, writer: &mut Writer<'_>) -> Result<usize, Trouble> {
        if rule.successors.len() == 1 {
            return Ok(0);
        }
        let draw = key.unit(purpose::CHOICE, 0);
        writer.machine.key = key;
        let (mut sum, mut choice) = (0.0, None);
        for (number, &weight) in rule.weights.iter().enumerate() {
            let weight = writer.machine.eval(weight)?;
            if !(0.0..=1.0).contains(&weight) {
                return Err(Trouble::ProbabilitySum(weight));
            }
            sum += weight;
            if choice.is_none() && draw < sum {
                choice = Some(number);
            }
        }
        if (sum - 1.0).abs() > SUM_TOLERANCE {
            return Err(Trouble::ProbabilitySum(sum));
        }
        Ok(choice.unwrap_or(rule.successors.len() - 1))
    }
}
