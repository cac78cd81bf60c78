//! Threads that are only counted: they take trees in order, and help with trees of others while none waits.

use super::dividing::Piece;
use std::collections::VecDeque;

/// Seconds until a thread that slept begins to help.
const START: f64 = 30e-6;
/// Parts that have to be left for threads to be called, and how often they have to be seen idle before.
const MIN_PARTS: usize = 4;
const SEEN: usize = 2;

/// A tree that is to be scored.
struct Tree {
    pieces: VecDeque<Piece>,
    /// What its pieces take where no thread helps, by what they take divided.
    alone: f64,
    /// How often in a row threads were idle.
    seen: usize,
    /// Whether threads have been called for the first of the pieces, and for any before.
    is_shared: bool,
    was_shared: bool,
    /// The next part of the first piece.
    next: usize,
    /// Threads that make parts.
    at_work: usize,
    done: Option<f64>,
}

#[derive(Clone, Copy, PartialEq)]
enum Task {
    Idle,
    /// Works for a tree of its own, or helps with that of another.
    Works {
        until: f64,
        tree: usize,
        owns: bool,
    },
    /// Its own tree's last parts are with others.
    Waits {
        tree: usize,
    },
}

pub(crate) struct Machine {
    tasks: Vec<Task>,
    now: f64,
    trees: Vec<Tree>,
    /// Trees that no thread has begun.
    first: usize,
    helps: bool,
    worked: f64,
    /// For which tree an idle thread comes across first.
    dice: u64,
}

impl Machine {
    pub(crate) fn new(threads: usize, helps: bool) -> Self {
        let tasks = vec![Task::Idle; threads];
        Self { tasks, now: 0.0, trees: Vec::new(), first: 0, helps, worked: 0.0, dice: 1 }
    }

    /// Submits a tree that takes one thread `seconds`, or the pieces if it is divided; returns its number.
    pub(crate) fn submit(&mut self, seconds: f64, pieces: &[Piece]) -> usize {
        let divided: f64 = pieces
            .iter()
            .map(|piece| match piece {
                Piece::Alone(seconds) => *seconds,
                Piece::Parts(parts) => parts.iter().sum(),
            })
            .sum();
        self.worked += seconds;
        self.trees.push(Tree {
            pieces: pieces.iter().cloned().collect(),
            alone: seconds / divided,
            seen: 0,
            is_shared: false,
            was_shared: false,
            next: 0,
            at_work: 0,
            done: None,
        });
        self.trees.len() - 1
    }

    /// Lets time pass until `tree` is done.
    pub(crate) fn wait_for(&mut self, tree: usize) {
        while self.trees[tree].done.is_none() {
            self.step();
        }
    }

    /// The share of its threads' time in which trees were scored that would have been on one thread as well.
    pub(crate) fn efficiency(&mut self) -> f64 {
        (0..self.trees.len()).for_each(|tree| self.wait_for(tree));
        self.worked / (self.now * self.tasks.len() as f64)
    }

    /// Gives idle threads work, and goes to when the next one is done.
    fn step(&mut self) {
        while let Some(thread) = self.tasks.iter().position(|task| *task == Task::Idle) {
            if !self.begin(thread) {
                break;
            }
        }
        let busy = self.tasks.iter().enumerate().filter_map(|(thread, task)| match *task {
            Task::Works { until, tree, owns } => Some((until, thread, tree, owns)),
            _ => None,
        });
        let next = busy.min_by(|a, b| a.0.total_cmp(&b.0)).expect("somebody works");
        let (until, thread, tree, owns) = next;
        self.now = until;
        if matches!(self.trees[tree].pieces.front(), Some(Piece::Parts(_))) {
            self.trees[tree].at_work -= 1;
            if let Some(seconds) = self.part(tree) {
                self.tasks[thread] = Task::Works { until: until + seconds, tree, owns };
            } else {
                self.tasks[thread] = if owns { Task::Waits { tree } } else { Task::Idle };
                if self.trees[tree].at_work == 0 {
                    self.next_piece(tree);
                }
            }
        } else {
            self.tasks[thread] = Task::Waits { tree };
            self.next_piece(tree);
        }
    }

    /// Gives `thread` something to do, as rayon does: parts of other trees before a tree of its own.
    fn begin(&mut self, thread: usize) -> bool {
        let has_parts = |tree: &Tree| match tree.pieces.front() {
            Some(Piece::Parts(parts)) => tree.is_shared && tree.next < parts.len(),
            _ => false,
        };
        let shared: Vec<usize> = (0..self.first)
            .filter(|&tree| self.trees[tree].done.is_none() && has_parts(&self.trees[tree]))
            .collect();
        if !shared.is_empty() {
            self.dice = self.dice.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let tree = shared[(self.dice >> 33) as usize % shared.len()];
            let seconds = START + self.part(tree).expect("it has parts");
            self.tasks[thread] = Task::Works { until: self.now + seconds, tree, owns: false };
            return true;
        }
        if self.first == self.trees.len() {
            return false;
        }
        let tree = self.first;
        self.first += 1;
        self.trees[tree].seen = usize::from(self.running() < self.tasks.len());
        self.tasks[thread] = Task::Waits { tree };
        self.start_piece(tree);
        true
    }

    /// The thread that waits for the first piece of `tree` goes on with the next.
    fn next_piece(&mut self, tree: usize) {
        let own = &mut self.trees[tree];
        own.was_shared |= own.is_shared;
        own.is_shared = false;
        own.next = 0;
        own.pieces.pop_front();
        self.start_piece(tree);
    }

    fn start_piece(&mut self, tree: usize) {
        let own = &self.trees[tree];
        let speed = if own.was_shared { 1.0 } else { own.alone };
        let seconds = match own.pieces.front() {
            None => None,
            Some(Piece::Alone(seconds)) => Some(seconds * speed),
            Some(Piece::Parts(parts)) if parts.is_empty() => Some(0.0),
            Some(Piece::Parts(_)) => self.part(tree),
        };
        let thread = self.tasks.iter().position(|task| *task == Task::Waits { tree });
        let thread = thread.expect("the thread whose tree it is");
        self.tasks[thread] = match seconds {
            Some(seconds) => Task::Works { until: self.now + seconds, tree, owns: true },
            None => {
                self.trees[tree].done = Some(self.now);
                Task::Idle
            }
        };
    }

    /// Threads that have a tree of their own, or help.
    fn running(&self) -> usize {
        self.tasks.iter().filter(|task| **task != Task::Idle).count()
    }

    /// Takes the next part of a tree: the seconds that it takes.
    fn part(&mut self, tree: usize) -> Option<f64> {
        let running = self.running();
        let own = &mut self.trees[tree];
        let Some(Piece::Parts(parts)) = own.pieces.front() else { return None };
        let seconds = parts.get(own.next)?;
        if !own.is_shared {
            own.seen = if running < self.tasks.len() { own.seen + 1 } else { 0 };
            own.is_shared = self.helps && own.seen >= SEEN && parts.len() - own.next >= MIN_PARTS;
        }
        own.next += 1;
        own.at_work += 1;
        Some(seconds * if own.is_shared { 1.0 } else { own.alone })
    }
}
