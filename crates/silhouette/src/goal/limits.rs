//! How large a picture may be.

/// Largest width and height that are read, in pixels.
pub const MAX_SIDE: u32 = 8192;
/// Smallest width and height of a goal, in pixels.
pub const MIN_SIDE: u32 = 8;
/// Most bytes that a file, or a decoded picture, may have: 8192² pixels of four bytes.
pub const MAX_BYTES: u64 = 4 * MAX_SIDE as u64 * MAX_SIDE as u64;
/// Most bytes that a PNG may carry beside its pixels, unpacked: colour profile and texts.
pub(super) const MAX_BESIDE: u64 = 32 << 20;
