//! pleach grows procedural trees, draws them, and finds the parameters that make them look like a
//! picture.
//!
//! A *species* is a list of numbers. With a *seed* it grows a *tree*; a tree seen from somewhere is a
//! *silhouette*; and a *fit* goes the other way, from a silhouette to a species.
//!
//! # Grow
//!
//! Species come by name, or from a file. The same species and seed give the same tree, bit for bit.
//!
//! ```
//! let species = pleach::species("quaking_aspen")?;
//! let tree = species.grow(1)?;
//! println!("{} stems, {} leaves", tree.stems.len(), tree.leaves.len());
//! # assert!(tree.leaves.len() > 1000);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Draw a silhouette
//!
//! [`silhouette`] is one picture; a [`Rasterizer`] draws many and keeps its memory.
//!
//! ```
//! use pleach::View;
//!
//! let tree = pleach::species("silver_birch")?.grow(42)?;
//! let picture = pleach::silhouette(&tree, View::FRONT, 256);
//! println!("{} of {} pixels are tree", picture.ink(), picture.area());
//! # assert!(picture.ink() > 1000);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Fit a picture
//!
//! The goal is a picture and the height of its tree in metres. Here it is one of our own trees.
//!
//! ```
//! use pleach::{Budget, Control, FitProblem, FitSettings, Goal, GoalView, Unknown, View};
//! use std::sync::atomic::AtomicBool;
//! use std::time::Instant;
//!
//! let species = pleach::species("acer")?;
//! let goal = Goal::from_bitmap(pleach::silhouette(&species.grow(7)?, View::FRONT, 64))?;
//! let frame = goal.frame(12.0);
//! let view = GoalView { goal: goal.bitmap, view: View::FRONT, frame, unknown: Unknown::default() };
//! let problem = FitProblem {
//!     generator: species.generator.clone(),
//!     base: species.generator.space().defaults(),
//!     goals: vec![view],
//!     foliage: true,
//! };
//! let budget = Budget { evaluations: Some(10), ..Budget::default() };
//! let settings = FitSettings { budget, ..FitSettings::default() };
//! let (start, stop) = (Instant::now(), AtomicBool::new(false));
//! let outcome = pleach::fit(&problem, &settings, Control::new(&|| start.elapsed(), &stop))?;
//! let best = outcome.best.ok_or("nothing was evaluated")?;
//! println!("cost {:.3} after {} trees", best.score.cost, outcome.evaluations);
//! # assert!(best.score.cost < 1.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Blend species
//!
//! [`mix`] gives a species between others; a [`BlendMap`] lays them out on a plane, with a species for
//! every point of it.
//!
//! ```
//! let (aspen, birch) = (pleach::species("quaking_aspen")?, pleach::species("silver_birch")?);
//! let between = pleach::mix(vec![aspen, birch], &[0.7, 0.3], "aspen_and_birch")?;
//! let tree = between.grow(1)?;
//! print!("{}", between.to_toml(&[]));
//! # assert!(!tree.stems.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Make a mesh, and a shaded picture
//!
//! [`write_glb`] writes one tree; [`send`] streams any [`Mesher`]s to a file of any format, or into
//! a [`Mesh`].
//!
//! ```
//! use pleach::Palette;
//!
//! let species = pleach::species("acer")?;
//! let tree = species.grow(1)?;
//! let palette = Palette::of(&species, None);
//! let mut glb = std::io::Cursor::new(Vec::new());
//! pleach::write_glb(&mut glb, "acer", &tree, &palette)?;
//! let picture = pleach::render(&tree, &palette, 128);
//! picture.write_png(&mut std::io::sink())?;
//! # assert!(glb.into_inner().starts_with(b"glTF"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Features
//!
//! `fit`, `blend`, `mesh` and `render`, all on by default. Growing and silhouettes are always there.
//! The crates below this one (`pleach-tree`, `pleach-silhouette`, …) have what is not named here.
#![cfg_attr(docsrs, feature(doc_cfg))]

/// The vectors of the public types.
pub use glam;
pub use pleach_generators::{
    RegistryError, names as species_names, read as read_species, read_file as read_species_file, species,
};
pub use pleach_silhouette::score::ScoreCard;
pub use pleach_silhouette::{
    Bitmap, Detail, Frame, Goal, GoalError, GoalOptions, GoalWarning, Polarity, Projection, Rasterizer, View,
    silhouette,
};
pub use pleach_tree::leaf_shape::{BlossomShape, LeafShape, Outline, OutlineError};
pub use pleach_tree::species::{Appearance, Color, Season};
pub use pleach_tree::stats::Bounds;
pub use pleach_tree::{
    Blame, Blob, CheckedParams, Conflict, Family, Foliage, Generator, GrowError, Growth, Knot, Leaf, Limits,
    MalformedTree, ModelId, Param, ParamSpace, Parts, Slot, Species, SpeciesDoc, SpeciesError, Stem,
    StemKind, Tree, TreeStats, Workspace,
};
/// What generators of your own are made of; `docs/a-generator.md` shows how.
pub use pleach_tree::{param, random, species};

#[cfg(feature = "fit")]
pub use pleach_fit::{
    Budget, Control, FitError, FitProblem, FitSettings, Genome, GoalView, Objective, Observer, Optimizer,
    Outcome, Progress, Score, Scored, Start, StopReason, TreeSeed, Unknown, fit,
};

#[cfg(feature = "blend")]
pub use pleach_blend::{Blend, BlendError, BlendMap, Point, Settings as MapSettings, Weights, mix};

#[cfg(feature = "mesh")]
pub use pleach_mesh::{
    LeafStyle, Material, Mesh, MeshError, MeshSettings, Mesher, Palette, Sink, Source, send, write::glb::Glb,
    write::glb::write as write_glb, write::obj::Obj, write::ply::Ply, write::stl::Stl, write::usda::Usda,
};

#[cfg(feature = "render")]
pub use pleach_render::{
    Billboards, Picture, Preview, PreviewSettings,
    preview::{Background, Ground, render},
};

/// The listing of the README.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
