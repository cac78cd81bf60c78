//! The keys of every species file beside the parameters.

use super::appearance;
use super::individual;
use super::key::{Form, Key};

/// The keys that every species file may have, whatever its generator.
pub const KEYS: &[Key] = &[
    Key {
        name: "generator",
        form: Form::Text,
        default: "the first that is known",
        doc: "the generator that grows the species",
    },
    Key { name: "name", form: Form::Text, default: "the file's", doc: "short name of the species" },
    Key { name: "description", form: Form::Text, default: "none", doc: "one line about the species" },
    Key {
        name: "tree_seed",
        form: Form::Seed,
        default: "none",
        doc: "the seed of one particular tree, grown where no other seed is asked for",
    },
    Key {
        name: "bare",
        form: Form::Switch,
        default: "false",
        doc: "whether trees are grown without leaves and blossoms where nothing else is asked for",
    },
    Key {
        name: "appearance",
        form: Form::Table(&appearance::KEYS),
        default: "none",
        doc: "colours and season, for pictures and meshes; the tree's form does not depend on it",
    },
    Key {
        name: "individual",
        form: Form::Table(&individual::KEYS),
        default: "none",
        doc: "stems of the tree of seed `tree_seed` that have draws of their own; other seeds are as without it",
    },
];
