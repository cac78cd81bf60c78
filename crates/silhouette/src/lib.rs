//! Cameras, a bit-packed rasteriser, goal images and image scores.
