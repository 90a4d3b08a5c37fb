//! Words of an option, from the table that gives them their values.
#![forbid(unsafe_code)]

/// The words of a table, and others after them; N is how many they are together.
pub(super) const fn words<T, const N: usize>(
    table: &[(&'static str, T)],
    others: &[&'static str],
) -> [&'static str; N] {
    let mut words = [""; N];
    let mut at = 0;
    while at < N {
        words[at] = match at < table.len() {
            true => table[at].0,
            false => others[at - table.len()],
        };
        at += 1;
    }
    words
}
