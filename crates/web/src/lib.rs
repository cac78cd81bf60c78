//! The library for the web page in `web/`: the facade in JavaScript's types, and no algorithm.
//!
//! Structured answers are JSON text, bulk is typed arrays, errors are sentences. Nothing here waits or starts
//! threads: the page runs an instance of this module in each of its workers, and throws a worker away whose module
//! has panicked.
#![cfg_attr(not(test), warn(clippy::disallowed_types))]

mod catalogue;
mod error;
mod fit;
mod goal;
mod grammar;
mod grammar_text;
mod map;
mod mesh;
mod message;
mod panic;
mod report;
mod species;
mod tree;
