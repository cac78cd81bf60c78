//! Tests of the tree itself: what its files say about each other.
//!
//! | file | what it checks |
//! | --- | --- |
//! | `documents.rs` | paths, links, names and options in documents are in the tree |

mod documents;
mod markdown;
mod tree;
mod words;
