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
//! [`fit_picture`] is the whole fit of a picture: a file, the bytes of one, or a [`Bitmap`]. [`FitOptions`] say what
//! is asked for, and the [`FitReport`] what was found.
//!
//! ```
//! use pleach::{Control, FitOptions, View, fit_picture};
//! use std::sync::atomic::AtomicBool;
//! use std::time::Instant;
//!
//! // One of our own trees; "oak.png" is a picture as well.
//! let goal = pleach::silhouette(&pleach::species("acer")?.grow(7)?, View::FRONT, 64);
//! let options = FitOptions { height: 12.0, size: 64, evaluations: Some(10), ..FitOptions::default() };
//! let (start, stop) = (Instant::now(), AtomicBool::new(false));
//! let report = fit_picture(goal, &options, Control::new(&|| start.elapsed(), &stop))?;
//! println!("IoU {:.3} of a tree such as {}", report.scores.iou, report.looks_like[0].species);
//! print!("{}", report.best().species.to_toml(&[]));
//! # assert_eq!(report.looks_like[0].species, "acer");
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
//! [`Export`] says what a mesh file is to hold, and writes it; [`send`] streams any [`Mesher`]s to a file of any
//! format, or into a [`Mesh`].
//!
//! ```
//! use pleach::{Export, MeshFormat};
//!
//! let species = pleach::species("acer")?;
//! let tree = species.grow(1)?;
//! let export = Export { lod: Some(3), ..Export::default() };
//! let mut glb = std::io::Cursor::new(Vec::new());
//! export.write(MeshFormat::Glb, &species, 1, &tree, None, &mut glb)?;
//! let picture = pleach::render(&tree, &export.palette(&species), 128);
//! picture.write_png(&mut std::io::sink())?;
//! # assert!(glb.into_inner().starts_with(b"glTF"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Features
//!
//! `fit`, `blend`, `mesh` and `render`, all on by default. Growing and silhouettes are always there.
//! The crates below this one (`pleach-tree`, `pleach-silhouette`, …) have what is not named here.
#![cfg_attr(not(test), warn(clippy::disallowed_types))]
#![cfg_attr(docsrs, feature(doc_cfg))]

/// The vectors of the public types.
pub use glam;
pub use pleach_generators::{
    GeneratorChoice, HEWITT_2017, RegistryError, families, names as species_names, read as read_species,
    read_file as read_species_file, species,
};
pub use pleach_silhouette::goal::{Crop, Encoded};
pub use pleach_silhouette::mask::{Mask, MaskError, MaskOptions, Photo};
pub use pleach_silhouette::score::{ScoreCard, ScoreColumn};
pub use pleach_silhouette::{
    Bitmap, Detail, FOUR_VIEWS, Frame, Goal, GoalError, GoalOptions, GoalWarning, Polarity, Projection,
    Rasterizer, View, four_views, silhouette,
};
pub use pleach_tree::leaf_shape::{BlossomShape, LeafShape, Outline, OutlineError};
pub use pleach_tree::{
    Address, Appearance, Blame, Blob, Bounds, CheckedParams, Color, Conflict, Draw, Draws, Family, Foliage,
    Generator, GrowError, Growth, Hull, HullView, Individual, Key, Knot, Leaf, Limits, MalformedTree,
    ModelId, Param, ParamSpace, Parts, Season, Slot, Species, SpeciesDoc, SpeciesError, Spread, Stem,
    StemKind, Tree, TreeStats, Variation, Workspace,
};
/// What generators of your own are made of; `docs/a-generator.md` shows how.
pub use pleach_tree::{param, parameters, random, species};

mod skeleton;
pub use skeleton::{Cylinder, Skeleton, SkeletonFormat, SkeletonNode};

#[cfg(test)]
mod shared;

#[cfg(feature = "fit")]
mod at_full_size;
#[cfg(feature = "fit")]
pub use at_full_size::place_at_full_size;

#[cfg(feature = "fit")]
pub use pleach_fit::{
    Accuracy, Answer, Assessment, AssessmentSettings, Budget, COLUMNS, Candidate, Contradictions, Control,
    CostModel, Deadline, Drawings, DrawingsError, EvalWorkspace, Evaluator, FirstGuess, FitError, FitProblem,
    FitSettings, Fitted, FoundIndividual, Freedom, Gene, Genome, GoalSettings, GoalView, GuessLibrary,
    GuessSettings, Guessing, Identifiability, IndividualProgress, IndividualSettings, Interval, LearntParts,
    NoSample, Objective, Observer, ObserverError, Optimizer, Outcome, Placement, Posterior, PosteriorModel,
    PosteriorNumber, PosteriorSettings, PredictorError, Predictors, PreparedSearch, Prior, Profile, Progress,
    Reserve, Row, RulesSettings, Score, Scored, SearchSpace, Setting, Start, Stepwise, StepwiseRace,
    StopReason, TreeSeed, Unknown, Verdict, evaluator, fit, fit_goal, fit_goal_with, individuals,
};
#[cfg(feature = "fit")]
pub use pleach_fit::{
    Agreement, AnyEvidence, ArgminSolver, CheckpointSettings, CmaSettings, Evidence, EvolutionSettings,
    HewittSettings, Method, PlacedTree, RandomSettings, ShadeSettings, Terms, fresh_seeds, profile,
};

#[cfg(feature = "fit")]
pub use pleach_reading::{
    Anchor, Colors, Crown, Difference, Foot, Measure, Reader, Reading, ReadingError, annotate,
};

#[cfg(feature = "fit")]
mod picture;
#[cfg(feature = "fit")]
pub use picture::{
    AppearanceFrom, Corrections, Direction, Effort, FitDrawing, FitOptions, FitReport, FitSource, FitStart,
    FittedTree, FurtherPicture, FurtherView, GoalPair, GoalReading, IdentifiabilityCounts, IndividualReport,
    IntervalsReport, KnownFrame, Leaves, LooksLike, MaskFrom, MaskHints, NextStep, NumberReport,
    ParameterReport, PictureError, PictureReading, PictureSource, PosteriorReport, PrepareError, Prepared,
    Readings, ReportError, RulesReport, SearchReport, SettingError, SideTree, SidesReport, Spent, StartFrom,
    TIME_KEYS, Tone, ViewReport, VolumeFrom, best_of_each_family, fit_picture, optimizer_with,
    parse_duration, read_picture, settings_of,
};

#[cfg(feature = "fit")]
pub mod plan;

#[cfg(feature = "blend")]
pub use pleach_blend::{Blend, BlendError, BlendMap, Point, Settings as MapSettings, Weights, mix};

#[cfg(feature = "options")]
mod option_error;
#[cfg(feature = "options")]
pub use option_error::OptionError;

#[cfg(feature = "render")]
mod export;
#[cfg(feature = "render")]
pub use export::{
    Beside, Compression, Export, ExportError, ExportedFile, ExportedMeshes, Forest, LeafForm, Written,
};

#[cfg(feature = "mesh")]
pub use pleach_mesh::write::{Feature as MeshFeature, Format as MeshFormat};
#[cfg(feature = "mesh")]
pub use pleach_mesh::{
    Emergence, LeafStyle, Material, Mesh, MeshError, MeshSettings, Mesher, Palette, Pictures, Pivots, Sink,
    Source, Wind, growth, send, tangents, wind, write::glb::Glb, write::glb::write as write_glb,
    write::obj::Obj, write::ply::Ply, write::stl::Stl, write::usda::Usda,
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
