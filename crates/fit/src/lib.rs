//! Objectives, optimisers and checkpoints: finds the parameters of a goal image.
