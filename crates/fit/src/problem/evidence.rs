//! Evidence: what a goal knows of its tree, and how a tree is compared with it.

use super::objective::Objective;
use pleach_silhouette::{Bitmap, Frame, View};
use pleach_tree::{Helpers, Parts, Tree};
use std::any::Any;
use std::fmt;
use std::sync::Arc;

/// The evidence of a goal: how it is prepared, how a tree is drawn, and how the two are compared.
///
/// A goal's evidence is its silhouette, unless [`GoalView::evidence`](crate::GoalView::evidence) is another. The
/// evaluator grows a tree, places it as the goal's picture shows it, and asks the evidence for an [`Agreement`]: the
/// evidence decides which layers of the tree it draws and which terms make its value. All else that a fit does sees
/// scores only. What a goal knows beside its picture, such as depths or the layer of its wood, is a field of the
/// evidence.
///
/// ```
/// use pleach_fit::{Agreement, AnyEvidence, Evidence, GoalView, PlacedTree, Terms};
/// use pleach_silhouette::Bitmap;
///
/// /// How tall the tree is, in metres, measured by hand.
/// #[derive(Debug)]
/// struct Height(f64);
///
/// impl Evidence for Height {
///     type Goal = ();
///     type Memory = f64;
///
///     fn prepare(&self, _: &Bitmap) {}
///
///     fn draw(&self, placed: &PlacedTree<'_>, height: &mut f64) {
///         *height = placed.tree.knots.iter().map(|knot| knot.point.z).fold(0.0, f64::max);
///     }
///
///     fn compare(&self, _: &(), _: Terms, height: &mut f64) -> Agreement {
///         let height = *height;
///         Agreement::from_value(height.min(self.0) / height.max(self.0))
///     }
/// }
///
/// # let (picture, frame) = (Bitmap::new(8, 8), pleach_silhouette::Frame { width: 8, height: 8, meters_per_pixel: 1.0, axis_column: 4.0, ground_row: 8.0 });
/// let goal = GoalView::new(picture, pleach_silhouette::View::FRONT, frame);
/// let goal = GoalView { evidence: Some(AnyEvidence::new(Height(12.5))), ..goal };
/// # assert!(goal.evidence.is_some());
/// ```
pub trait Evidence: fmt::Debug + Send + Sync + 'static {
    /// A goal, prepared for many comparisons.
    type Goal: fmt::Debug + Send + Sync + 'static;
    /// Memory of one thread, reused from tree to tree: what was drawn of a tree, and buffers.
    type Memory: Default + Send + 'static;

    /// Prepares the goal whose picture is `picture`.
    fn prepare(&self, picture: &Bitmap) -> Self::Goal;

    /// Draws the layers of a tree that a comparison needs.
    fn draw(&self, placed: &PlacedTree<'_>, memory: &mut Self::Memory);

    /// Compares the tree that was drawn last with the goal.
    fn compare(&self, goal: &Self::Goal, terms: Terms, memory: &mut Self::Memory) -> Agreement;
}

/// A tree as it stands in a goal's picture.
#[derive(Clone, Copy, Debug)]
pub struct PlacedTree<'a> {
    /// The tree.
    pub tree: &'a Tree,
    /// The direction of view.
    pub view: View,
    /// Scale and place in the picture.
    pub frame: Frame,
    /// Which parts of the tree the problem is about.
    pub parts: Parts,
    /// Threads that may help to draw it; for [`Rasterizer::helped`](pleach_silhouette::Rasterizer::helped).
    pub helpers: Option<&'a dyn Helpers>,
}

/// The terms of a comparison that are asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Terms {
    /// What [`Agreement::value`] is. Evidence with a value of its own ignores it.
    pub objective: Objective,
    /// Whether the likeness is asked for even if the objective does not use it.
    pub likeness: bool,
}

/// How a tree agrees with a goal, each term in 0..=1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// The value that a search maximises: the cost is 1 minus the mean over goals.
    pub value: f64,
    /// Intersection over union of the ink, pixel by pixel.
    pub iou: f64,
    /// Share of equal pixels.
    pub accuracy: f64,
    /// Likeness, where it was measured.
    pub likeness: Option<f64>,
}

impl Agreement {
    /// A value alone, of evidence that has no silhouette: its other terms are 0 and `None`.
    #[must_use]
    pub const fn from_value(value: f64) -> Self {
        Self { value, iou: 0.0, accuracy: 0.0, likeness: None }
    }
}

/// [`Evidence`] of any type.
///
/// Two runs are the same only if the `Debug` texts of their evidence are.
#[derive(Clone)]
pub struct AnyEvidence(Arc<dyn Erased>);

impl AnyEvidence {
    /// `evidence`, whatever its type.
    #[must_use]
    pub fn new(evidence: impl Evidence) -> Self {
        Self(Arc::new(evidence))
    }

    pub(crate) fn prepare(&self, picture: &Bitmap) -> Box<dyn PreparedEvidence> {
        Arc::clone(&self.0).prepare_erased(picture)
    }
}

impl fmt::Debug for AnyEvidence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// Evidence without its types.
trait Erased: fmt::Debug + Send + Sync {
    fn prepare_erased(self: Arc<Self>, picture: &Bitmap) -> Box<dyn PreparedEvidence>;
}

/// Evidence and its goal without their types: one virtual call per tree and goal.
pub(crate) trait PreparedEvidence: fmt::Debug + Send + Sync {
    /// Memory for one thread.
    fn memory(&self) -> Box<dyn Any + Send>;

    /// Draws and compares a tree in memory that is [`Self::memory`]'s.
    fn measure(&self, placed: &PlacedTree<'_>, terms: Terms, memory: &mut (dyn Any + Send)) -> Agreement;
}

/// Evidence with its prepared goal.
#[derive(Debug)]
struct Prepared<E: Evidence> {
    evidence: Arc<E>,
    goal: E::Goal,
}

impl<E: Evidence> Erased for E {
    fn prepare_erased(self: Arc<Self>, picture: &Bitmap) -> Box<dyn PreparedEvidence> {
        let goal = self.prepare(picture);
        Box::new(Prepared { evidence: self, goal })
    }
}

impl<E: Evidence> PreparedEvidence for Prepared<E> {
    fn memory(&self) -> Box<dyn Any + Send> {
        Box::<E::Memory>::default()
    }

    fn measure(&self, placed: &PlacedTree<'_>, terms: Terms, memory: &mut (dyn Any + Send)) -> Agreement {
        let memory = memory.downcast_mut::<E::Memory>().expect("memory of this evidence");
        self.evidence.draw(placed, memory);
        self.evidence.compare(&self.goal, terms, memory)
    }
}
