use super::pairs;

#[test]
fn of_two_more_groups_than_outliers_two_are_free_of_them_and_of_one_more_not() {
    let free = |groups: usize, spoilt: &[usize]| pairs(groups).any(|pair| spoilt.iter().all(|one| !pair.contains(one)));
    for outliers in 1..5 {
        let spoilt: Vec<usize> = (0..outliers).collect();
        assert!(free(outliers + 2, &spoilt));
        assert!(!free(outliers + 1, &spoilt));
    }
}
