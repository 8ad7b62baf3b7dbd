//! `selfosc reproduce` as it is printed.

use assert_cmd::Command;

use crate::golden;

fn reproduce(arguments: &[&str]) -> String {
    let output = Command::cargo_bin("selfosc").unwrap().arg("reproduce").args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn summary() {
    golden!("reproduce", reproduce(&[]));
}

#[test]
fn help() {
    golden!("reproduce-help", reproduce(&["--help"]));
}

#[test]
fn table_2() {
    golden!("table2", reproduce(&["--only", "table2"]));
}

#[test]
fn table_3() {
    golden!("table3", reproduce(&["--only", "table3"]));
}

#[test]
fn table_3_in_latex() {
    let folder = tempfile::tempdir().unwrap();
    reproduce(&["--only", "table3", "--out", folder.path().to_str().unwrap()]);
    golden!("table3-latex", std::fs::read_to_string(folder.path().join("table3.tex")).unwrap());
}

/// Formulas are MathML, every figure is explained, every column has a name.
#[test]
fn the_page_explains_itself() {
    let folder = tempfile::tempdir().unwrap();
    reproduce(&["--out", folder.path().to_str().unwrap()]);
    let page = std::fs::read_to_string(folder.path().join("report.html")).unwrap();
    // Equation 6, Tables 2 and 3, and their symbols.
    assert_eq!(page.matches("<math").count(), 1 + 4 * 3 + 8 + 2 * 5 + 8);
    assert!(!page.contains("<merror"));
    assert_eq!(page.matches("<svg").count(), page.matches("<figcaption>").count());
    assert!(!page.contains("<figcaption></figcaption>") && !page.contains("<th></th>"));
}

#[test]
fn table_4() {
    golden!("table4", reproduce(&["--only", "table4"]));
}

#[test]
fn figure_15() {
    golden!("fig15", reproduce(&["--only", "fig15"]));
}

#[test]
fn audit() {
    golden!("audit", reproduce(&["--only", "audit"]));
}
