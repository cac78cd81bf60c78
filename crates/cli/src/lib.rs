//! pleach finds the parameters of procedural trees that make them look like pictures.
//!
//! This crate is the facade: each part of pleach under one name. The program of the same name is
//! built on nothing else.
//!
//! ```
//! use pleach::tree::TreeStats;
//!
//! let species = pleach::generators::species("quaking_aspen").unwrap();
//! let tree = species.grow(1).unwrap();
//! println!("{} leaves", TreeStats::new(&tree).leaves);
//! ```

pub use pleach_blend as blend;
pub use pleach_fit as fit;
pub use pleach_generators as generators;
pub use pleach_mesh as mesh;
pub use pleach_silhouette as silhouette;
pub use pleach_tree as tree;
pub use pleach_weber_penn as weber_penn;
