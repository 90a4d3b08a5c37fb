//! How much of a long list of cases a run takes.

/// The ordinary run takes every `nth` case; the long ones, for which `make test-long` sets `MANYVIEW_TESTS_ALL`, take each.
pub(crate) fn every(nth: usize) -> usize {
    match std::env::var_os("MANYVIEW_TESTS_ALL") {
        Some(_) => 1,
        None => nth,
    }
}
