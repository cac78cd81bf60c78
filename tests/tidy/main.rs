//! Tests of the tree itself: what its files say about each other.
//!
//! | file | what it checks |
//! | --- | --- |
//! | `circles.rs` | the files of each crate use each other in one direction |
//! | `documents.rs` | paths, links, names and options in documents are in the tree |
//! | `packages.rs` | what every published package has |
//! | `floors.rs` | the map in `ARCHITECTURE.md` against the manifests; the index of decisions |
//! | `style.rs` | words that `docs/style.md` rules out |

mod circles;
mod documents;
mod floors;
mod markdown;
mod packages;
mod style;
mod tree;
mod uses;
mod words;
