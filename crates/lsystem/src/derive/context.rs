//! Left and right contexts.

use super::string::Modules;
use crate::program::{CLOSE, CLOSE_POLYGON, Formal, KindIndex, OPEN, OPEN_POLYGON, Pattern, Program};

/// What contexts need to know of a string: where each module's arguments begin, and which brackets
/// belong together.
pub(super) struct Surroundings {
    offsets: Vec<u32>,
    /// The other bracket of each bracket.
    partners: Vec<u32>,
}

impl Surroundings {
    pub(super) fn new(program: &Program, string: &Modules) -> Self {
        let (mut offsets, mut partners) = (Vec::new(), vec![0; string.kinds.len()]);
        let (mut offset, mut open) = (0, Vec::new());
        for (i, &kind) in string.kinds.iter().enumerate() {
            offsets.push(offset);
            offset += program.kinds[usize::from(kind)].arity as u32;
            if kind == OPEN {
                open.push(i);
            } else if kind == CLOSE
                && let Some(partner) = open.pop()
            {
                partners[i] = partner as u32;
                partners[partner] = i as u32;
            }
        }
        Self { offsets, partners }
    }
}

/// A place in a string whose context is compared.
pub(super) struct Place<'a> {
    pub(super) program: &'a Program,
    pub(super) string: &'a Modules,
    pub(super) surroundings: &'a Surroundings,
    /// Takes the arguments of the context's modules.
    pub(super) frame: &'a mut [f64],
    /// Modules looked at so far.
    pub(super) passed: u64,
}

impl Place<'_> {
    fn is_skipped(&self, kind: KindIndex) -> bool {
        matches!(kind, OPEN_POLYGON | CLOSE_POLYGON) || self.program.ignored[usize::from(kind)]
    }

    fn load(&mut self, at: usize, formal: Formal) -> bool {
        if self.string.kinds[at] != formal.kind {
            return false;
        }
        let arity = self.program.kinds[usize::from(formal.kind)].arity;
        let (from, to) = (self.surroundings.offsets[at] as usize, usize::from(formal.local));
        self.frame[to..to + arity].copy_from_slice(&self.string.values[from..from + arity]);
        true
    }

    /// Whether `formals`, the nearest last, stand to the left of module `at`: on the way to the root,
    /// without side branches.
    pub(super) fn left(&mut self, mut at: usize, formals: &[Formal]) -> bool {
        for &formal in formals.iter().rev() {
            loop {
                if at == 0 {
                    return false;
                }
                at -= 1;
                self.passed += 1;
                let kind = self.string.kinds[at];
                if kind == CLOSE {
                    at = self.surroundings.partners[at] as usize;
                } else if kind != OPEN && !self.is_skipped(kind) {
                    break;
                }
            }
            if !self.load(at, formal) {
                return false;
            }
        }
        true
    }

    /// Whether `patterns`, the nearest first, stand from module `at` on: along the same branch, with
    /// side branches where the pattern has them.
    pub(super) fn right(&mut self, mut at: usize, patterns: &[Pattern]) -> bool {
        for pattern in patterns {
            loop {
                let Some(&kind) = self.string.kinds.get(at) else { return false };
                self.passed += 1;
                match (kind, pattern) {
                    (CLOSE, _) => return false,
                    (OPEN, Pattern::Module(_)) => at = self.surroundings.partners[at] as usize + 1,
                    (OPEN, Pattern::Branch(inside)) => {
                        let end = self.surroundings.partners[at] as usize + 1;
                        let found = self.right(at + 1, inside);
                        at = end;
                        if found {
                            break;
                        }
                    }
                    _ if self.is_skipped(kind) => at += 1,
                    (_, Pattern::Module(formal)) => {
                        if !self.load(at, *formal) {
                            return false;
                        }
                        at += 1;
                        break;
                    }
                    (_, Pattern::Branch(_)) => return false,
                }
            }
        }
        true
    }
}
