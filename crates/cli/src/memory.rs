//! Returns freed memory to the system.
//!
//! Trees are grown into arrays of some megabytes, which live for a moment or for a whole search. The allocator of
//! glibc begins by giving such blocks back to the system when they are freed, but after the first few it keeps larger
//! and larger ones, up to 32 MB, in heaps of its own, one for each thread, between small ones that stay. A fit then
//! takes up to twice what it uses.

/// Blocks of this many bytes or more go back to the system at once. Faults cost nothing that can be measured: the
/// arrays of a search are kept from tree to tree.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const LARGE: libc::c_int = 256 << 10;

/// Makes the allocator return large blocks when they are freed.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
#[expect(unsafe_code, reason = "glibc has no other way but variables of the environment")]
pub(crate) fn give_back_large_blocks() {
    // SAFETY: it takes two numbers by value and sets one of the allocator's own; it may be called at any time.
    let _ = unsafe { libc::mallopt(libc::M_MMAP_THRESHOLD, LARGE) };
}

/// Returns free pages between small blocks; for after work that took many of them.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
#[expect(unsafe_code, reason = "nothing else in the library gives pages back that lie between blocks in use")]
pub(crate) fn give_back_the_rest() {
    // SAFETY: it takes a number by value and touches nothing but pages that are free; it may be called at any time.
    let _ = unsafe { libc::malloc_trim(0) };
}

/// Other allocators have ways of their own.
#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
pub(crate) const fn give_back_large_blocks() {}

/// Other allocators have ways of their own.
#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
pub(crate) const fn give_back_the_rest() {}
