//! Writes what successors say.

use super::machine::{MAX_REPEATS, Machine, Trouble, purpose};
use super::string::Modules;
use crate::program::{Act, Block, Program};
use pleach_tree::Key;

/// The address of modules from which nothing draws.
const NOBODY: u64 = 0;

/// Most arguments for each module that there is room for: bounds the memory of a string.
pub(super) const VALUES_PER_MODULE: usize = 4;

/// Writes modules until there are too many.
pub(super) struct Writer<'a> {
    pub(super) machine: Machine<'a>,
    pub(super) out: Modules,
    /// Most modules of `out`.
    pub(super) room: usize,
    /// Repeats so far, modules read, and the tolls of what was evaluated, those of earlier steps
    /// included.
    pub(super) work: u64,
    /// Most work.
    max_work: u64,
    nobody: Key,
}

impl<'a> Writer<'a> {
    /// `work` is what was done before, and the most of all.
    pub(super) fn new(
        program: &'a Program,
        globals: &'a [f64],
        out: Modules,
        room: usize,
        work: (u64, u64),
    ) -> Self {
        let machine = Machine::with_globals(program, globals);
        Self { machine, out, room, work: work.0, max_work: work.1, nobody: Key::root(NOBODY) }
    }

    /// Writes a block whose draws and modules have addresses under `key`.
    pub(super) fn block(&mut self, block: Block, key: Key) -> Result<(), Trouble> {
        let program = self.machine.program;
        self.machine.key = key;
        self.work += u64::from(block.toll);
        let mut at = block.start;
        while at < block.end {
            let act = program.acts[at as usize];
            at += 1;
            match act {
                Act::Run { start, len, position } => self.run((start, len), position, key),
                Act::Module { kind, args, position } => {
                    let info = &program.kinds[usize::from(kind)];
                    for i in 0..info.arity {
                        let value = self.machine.eval(program.codes[args as usize + i])?;
                        self.out.values.push(value);
                    }
                    self.out.kinds.push(kind);
                    if program.random {
                        let child =
                            if info.keyed { key.child(purpose::MODULE, position) } else { self.nobody };
                        self.out.keys.push(child);
                    }
                }
                Act::Let { local, value } => {
                    let value = self.machine.eval(program.codes[value as usize])?;
                    self.machine.frame[usize::from(local)] = value;
                }
                Act::Range { local, from, to, end, toll, site } => {
                    let low = self.machine.eval(program.codes[from as usize])?;
                    let high = self.machine.eval(program.codes[to as usize])?;
                    let count = (high - low).ceil().max(0.0);
                    if count > MAX_REPEATS as f64 {
                        let span = program.spans[program.codes[to as usize].start as usize];
                        return Err(Trouble::Repeats(span, count));
                    }
                    let key = key.child(purpose::REPEAT, site);
                    let body = Block { start: at, end, toll };
                    for i in 0..count as u32 {
                        self.machine.frame[usize::from(local)] = low + f64::from(i);
                        self.repeat(body, key, i)?;
                    }
                    at = end;
                }
                Act::List { local, first, count, end, toll, site } => {
                    let body = Block { start: at, end, toll };
                    for i in 0..count {
                        self.machine.key = key;
                        let value = self.machine.eval(program.codes[(first + i) as usize])?;
                        self.machine.frame[usize::from(local)] = value;
                        self.repeat(body, key.child(purpose::REPEAT, site), i)?;
                    }
                    at = end;
                }
            }
            self.machine.key = key;
        }
        Ok(())
    }

    fn repeat(&mut self, body: Block, key: Key, i: u32) -> Result<(), Trouble> {
        self.work += 1;
        self.block(body, key.child(purpose::REPEAT, i))?;
        self.check()
    }

    /// Whether there is room for what was written, and time for what was done.
    pub(super) const fn check(&self) -> Result<(), Trouble> {
        let too_many = self.out.kinds.len() > self.room
            || self.out.values.len() > self.room.saturating_mul(VALUES_PER_MODULE);
        if too_many {
            Err(Trouble::TooManySymbols(self.room))
        } else if self.work > self.max_work {
            Err(Trouble::TooMuchWork(self.max_work))
        } else {
            Ok(())
        }
    }

    /// Writes a slice of the program's runs.
    #[inline]
    pub(super) fn run(&mut self, (start, len): (u32, u32), position: u32, key: Key) {
        let program = self.machine.program;
        let run = &program.runs[start as usize..(start + len) as usize];
        self.out.kinds.extend_from_slice(run);
        if program.random {
            let nobody = self.nobody;
            self.out.keys.extend(run.iter().zip(position..).map(|(&kind, position)| {
                let keyed = program.kinds[usize::from(kind)].keyed;
                if keyed { key.child(purpose::MODULE, position) } else { nobody }
            }));
        }
    }
}
