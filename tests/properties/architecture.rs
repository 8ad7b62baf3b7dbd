//! Data flows one way: a module imports only from modules to its left.

use std::path::{Path, PathBuf};

/// The order of the modules. Those in one row may not import each other.
const ORDER: &[&[&str]] = &[
    &["files", "numeric"],
    &["proof"],
    &["nonlinearity"],
    &["describing"],
    &["plant"],
    &["balance", "orbit"],
    &["experiment"],
    &["features"],
    &["identify"],
    &["on_board"],
    &["vehicle"],
    &["control"],
    &["claims", "paper"],
    &["report"],
    &["error"],
    &["command"],
];

fn rank(module: &str) -> usize {
    ORDER
        .iter()
        .position(|row| row.contains(&module))
        .unwrap_or_else(|| panic!("module `{module}` has no place in the order: give it one in {}", file!()))
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
    found
}

/// Names that follow `crate::` in code: documentation may point anywhere.
fn imports(source: &str) -> Vec<String> {
    let code = source.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n");
    let name = |rest: &str| rest.chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '_').collect::<String>();
    code.split("crate::").skip(1).map(name).filter(|name| !name.is_empty()).collect()
}

/// Every import of `module` that does not point to the left, among `source`'s.
fn against_the_flow(module: &str, source: &str) -> Vec<String> {
    let here = rank(module);
    imports(source).into_iter().filter(|import| import != module && rank(import) >= here).collect()
}

#[test]
fn imports_point_to_the_left() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for path in sources(&root) {
        let inside = path.strip_prefix(&root).unwrap();
        let module = inside.components().next().unwrap().as_os_str().to_string_lossy();
        let module = module.strip_suffix(".rs").unwrap_or(&module).to_owned();
        // The root and the prelude hold nothing of their own.
        if matches!(module.as_str(), "lib" | "main" | "prelude") {
            continue;
        }
        let source = std::fs::read_to_string(&path).unwrap();
        let wrong = against_the_flow(&module, &source);
        assert!(wrong.is_empty(), "{} imports {wrong:?}, which is not to the left of `{module}`", inside.display());
    }
}

#[test]
fn an_import_to_the_right_is_found() {
    assert_eq!(against_the_flow("numeric", "use crate::describing::ClosedForm;"), ["describing"]);
    assert!(against_the_flow("describing", "use crate::numeric::Real;").is_empty());
}
