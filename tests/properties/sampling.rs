//! How many random cases and from which seed, for both generators of cases: the variables of proptest rule them all.

use proptest::test_runner::{Config, FileFailurePersistence, RngSeed};
use quickcheck::{Gen, QuickCheck};

/// Cases of a property that names no number, in both generators' terms.
const USUAL: u32 = 256;

/// `PROPTEST_CASES` is the usual number: a property that asks for more or fewer is scaled with it.
pub(crate) fn config(cases: u32) -> Config {
    let default = Config::default();
    let scaled = (u64::from(cases) * u64::from(default.cases)).div_ceil(USUAL.into());
    let cases = u32::try_from(scaled).unwrap_or(u32::MAX);
    // As many may fall outside a property's assumptions.
    Config { cases, max_global_rejects: default.max_global_rejects.max(cases), ..default }
}

/// The same, with failing cases kept beside the tests.
pub(crate) fn recorded(cases: u32) -> Config {
    Config { failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))), ..config(cases) }
}

/// quickcheck with the seed and the number of cases of proptest.
pub(crate) fn seeded() -> QuickCheck {
    const SIZE: usize = 100;
    let tests = u64::from(config(100).cases);
    let tester = QuickCheck::new().tests(tests).max_tests(100 * tests);
    match config(1).rng_seed {
        RngSeed::Fixed(seed) => tester.rng(Gen::from_size_and_seed(SIZE, seed)),
        RngSeed::Random => tester,
    }
}
