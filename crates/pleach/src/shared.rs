//! What threads may share and hand to each other. A type that stops being so does not compile.

const fn shared<T: Send + Sync>() {}
const fn sent<T: Send>() {}

const _: () = {
    shared::<crate::Species>();
    shared::<crate::Tree>();
    shared::<crate::Bitmap>();
    shared::<crate::Goal>();
    shared::<crate::Mask>();
    shared::<crate::Rasterizer>();
    shared::<crate::ParamSpace>();
    shared::<crate::CheckedParams>();
    shared::<crate::Individual>();
    // The memory of one grower, whatever it keeps there.
    sent::<crate::Workspace>();
    shared::<&dyn crate::Generator>();
    shared::<&dyn crate::Family>();
    shared::<crate::RegistryError>();
    shared::<crate::SpeciesError>();
    shared::<crate::GrowError>();
    shared::<crate::GoalError>();
};

#[cfg(feature = "fit")]
const _: () = {
    shared::<crate::FitOptions>();
    shared::<crate::FitReport>();
    shared::<crate::FitProblem>();
    shared::<crate::FitSettings>();
    shared::<crate::GoalSettings>();
    shared::<crate::Evaluator>();
    shared::<crate::GuessLibrary>();
    shared::<crate::Outcome>();
    shared::<crate::Fitted>();
    shared::<crate::FitError>();
    shared::<crate::PictureError>();
};

#[cfg(feature = "blend")]
const _: () = {
    shared::<crate::BlendMap>();
    shared::<crate::BlendError>();
};

#[cfg(feature = "mesh")]
const _: () = {
    shared::<crate::Mesh>();
    shared::<crate::Palette>();
    shared::<crate::MeshError>();
};

#[cfg(feature = "render")]
const _: () = {
    shared::<crate::Picture>();
    shared::<crate::Preview<'static>>();
};
