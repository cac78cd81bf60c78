//! Processor time, to the nanosecond. (What `/proc` counts moves by ticks of milliseconds.)

/// Seconds of processor time that this thread has taken.
pub(crate) fn of_thread() -> f64 {
    #[cfg(unix)]
    return seconds(rustix::time::ClockId::ThreadCPUTime);
    #[cfg(not(unix))]
    panic!("processor time is known on Unix only")
}

/// Seconds of processor time that all threads of this program have taken.
pub(crate) fn of_process() -> f64 {
    #[cfg(unix)]
    return seconds(rustix::time::ClockId::ProcessCPUTime);
    #[cfg(not(unix))]
    panic!("processor time is known on Unix only")
}

#[cfg(unix)]
fn seconds(clock: rustix::time::ClockId) -> f64 {
    let time = rustix::time::clock_gettime(clock);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}
