//! Data flows one way: a module imports only from modules to its left, no file from one that imports it, and no two types of a room
//! have one name.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The order of the modules. Those in one row may not import each other.
const ORDER: &[&[&str]] = &[
    &["numeric"],
    &["files"],
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
    &["autotune"],
    &["claims", "paper"],
    &["report"],
    &["error"],
    &["command"],
];

/// The order inside `identify`, by the same rule.
const INSIDE_IDENTIFY: &[&[&str]] =
    &[&["answer"], &["signal"], &["iso"], &["exact"], &["fit"], &["bounded"], &["design"], &["session"]];

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

/// A file of `src` as a module: its path from the root, and its code without comments and tests.
struct Module {
    path: Vec<String>,
    code: String,
}

impl Module {
    fn of(root: &Path, file: &Path) -> Option<Self> {
        let inside = file.strip_prefix(root).unwrap().with_extension("");
        let mut path: Vec<String> = inside.iter().map(|part| part.to_string_lossy().into_owned()).collect();
        if path.last().is_some_and(|last| last == "mod" || last == "lib") {
            path.pop();
        }
        let source = std::fs::read_to_string(file).unwrap();
        let source = source.split("#[cfg(test)]\nmod tests {").next().unwrap();
        let code = source.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n");
        let is_test = path.iter().any(|part| part == "tests" || part == "simulated" || part == "main");
        (!is_test).then_some(Self { path, code })
    }

    /// Paths that its code names, from the root; `names` are those of all modules.
    fn named(&self, names: &BTreeMap<Vec<String>, usize>) -> Vec<Vec<String>> {
        let mut found = Vec::new();
        for tree in self.code.split("use ").skip(1).filter_map(|rest| rest.split_once(';')).map(|(tree, _)| tree) {
            expand("", tree, &mut found);
        }
        // Paths outside of `use`; where a name is visible is no import.
        let inline = self.code.replace("pub(in super::super)", "pub");
        let starts = |word: &&str| ["crate::", "super::", "self::"].iter().any(|start| word.starts_with(start));
        let words = inline.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_' || c == ':'));
        found.extend(words.filter(starts).filter(|word| !word.ends_with(':')).map(str::to_owned));
        let absolute = |path: String| -> Option<Vec<String>> {
            let mut parts = path.split("::").filter(|part| !part.is_empty()).map(str::to_owned).peekable();
            let mut base = self.path.clone();
            match parts.peek().map(String::as_str)? {
                "crate" => base.clear(),
                "super" => {
                    while parts.next_if(|part| part == "super").is_some() {
                        base.pop();
                    }
                    base.extend(parts);
                    return Some(base);
                }
                "self" => {}
                child => {
                    let inner = [&base[..], &[child.to_owned()]].concat();
                    return names.contains_key(&inner).then(|| [base, parts.collect()].concat());
                }
            }
            base.extend(parts.skip(1));
            Some(base)
        };
        found.into_iter().filter_map(absolute).collect()
    }

    /// Where it has a name from that it hands on: `pub use child::Name`.
    fn handed_on(&self, name: &str) -> Option<Vec<String>> {
        let uses = self.code.split("use ").skip(1).filter_map(|rest| rest.split_once(';')).map(|(tree, _)| tree);
        let mut found = Vec::new();
        uses.for_each(|tree| expand("", tree, &mut found));
        let path = found.into_iter().find(|path| path.rsplit("::").next() == Some(name))?;
        let parts: Vec<String> = path.split("::").map(str::to_owned).collect();
        (!matches!(parts[0].as_str(), "crate" | "super" | "self")).then(|| [&self.path[..], &parts[..]].concat())
    }
}

/// The paths of a tree of imports, without what stands behind `as`.
fn expand(before: &str, tree: &str, found: &mut Vec<String>) {
    let tree = tree.trim();
    let Some((head, rest)) = tree.split_once('{') else {
        let name = tree.split(" as ").next().unwrap().trim();
        found.push(format!("{before}{name}"));
        return;
    };
    let inner = rest.rsplit_once('}').map_or(rest, |(inner, _)| inner);
    let (mut depth, mut begin) = (0, 0);
    for (at, c) in inner.char_indices().chain([(inner.len(), ',')]) {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                if !inner[begin..at].trim().is_empty() {
                    expand(&format!("{before}{head}"), &inner[begin..at], found);
                }
                begin = (at + 1).min(inner.len());
            }
            _ => {}
        }
    }
}

/// For each module the modules that it imports from, through whatever hands a name on.
fn imports_between(modules: &[Module]) -> Vec<BTreeSet<usize>> {
    let names: BTreeMap<Vec<String>, usize> =
        modules.iter().enumerate().map(|(number, module)| (module.path.clone(), number)).collect();
    let defining = |mut path: Vec<String>| -> Option<usize> {
        for _ in 0..8 {
            let length = (0..=path.len()).rev().find(|length| names.contains_key(&path[..*length]))?;
            let number = names[&path[..length]];
            match path.get(length).and_then(|name| modules[number].handed_on(name)) {
                Some(next) if next != path => path = next,
                _ => return Some(number),
            }
        }
        None
    };
    let of = |(number, module): (usize, &Module)| {
        let found: BTreeSet<usize> = module.named(&names).into_iter().filter_map(defining).collect();
        found.into_iter().filter(|other| *other != number && !modules[*other].path.is_empty()).collect()
    };
    modules.iter().enumerate().map(of).collect()
}

/// Modules that can be come back to, each with a module that it imports from on the way.
fn circles(arrows: &[BTreeSet<usize>]) -> Vec<(usize, usize)> {
    let reached = |from: usize| {
        let (mut seen, mut open) = (BTreeSet::new(), vec![from]);
        while let Some(next) = open.pop() {
            open.extend(arrows[next].iter().filter(|other| seen.insert(**other)));
        }
        seen
    };
    let reached: Vec<BTreeSet<usize>> = (0..arrows.len()).map(reached).collect();
    let pairs = arrows.iter().enumerate().flat_map(|(from, to)| to.iter().map(move |to| (from, *to)));
    pairs.filter(|(from, to)| reached[*to].contains(from)).collect()
}

fn modules() -> Vec<Module> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    sources(&root).iter().filter_map(|file| Module::of(&root, file)).collect()
}

#[test]
fn no_file_of_identify_imports_from_one_that_imports_it() {
    let modules = modules();
    let arrows = imports_between(&modules);
    let shown = |number: usize| modules[number].path.join("::");
    let checked = |number: usize| modules[number].path[0] == "identify";
    let found: Vec<String> = circles(&arrows)
        .into_iter()
        .filter(|(from, to)| checked(*from) && checked(*to))
        .map(|(from, to)| format!("{} -> {}", shown(from), shown(to)))
        .collect();
    assert!(found.is_empty(), "circles: {found:#?}");
}

#[test]
fn imports_inside_identify_point_to_the_left() {
    let modules = modules();
    let arrows = imports_between(&modules);
    let rank = |module: &Module| {
        let room = module.path.get(1).filter(|_| module.path[0] == "identify")?;
        Some(
            INSIDE_IDENTIFY
                .iter()
                .position(|row| row.contains(&room.as_str()))
                .unwrap_or_else(|| panic!("no place for {room}")),
        )
    };
    let mut between = BTreeSet::new();
    for (from, to) in arrows.iter().enumerate().flat_map(|(from, to)| to.iter().map(move |to| (from, *to))) {
        if let (Some(here), Some(there)) = (rank(&modules[from]), rank(&modules[to])) {
            assert!(there <= here, "{} imports {}", modules[from].path.join("::"), modules[to].path.join("::"));
            between.insert((here, there));
        }
    }
    between.retain(|(here, there)| here != there);
    assert!(between.len() > INSIDE_IDENTIFY.len(), "{between:?}");
}

/// Names of types that a file declares.
fn declared(code: &str) -> BTreeSet<String> {
    let name = |line: &str| {
        let line =
            line.strip_prefix("pub ").or_else(|| line.strip_prefix("pub(")?.split_once(") ").map(|(_, rest)| rest));
        let kinds = ["struct ", "enum ", "union ", "trait ", "type "];
        let of = |line: &str| kinds.iter().find_map(|kind| line.strip_prefix(kind)).map(str::to_owned);
        line.and_then(of)
    };
    let names = code.lines().filter_map(|line| name(line).or_else(|| name(&format!("pub {line}"))));
    let ends = |c: char| !(c.is_ascii_alphanumeric() || c == '_');
    names.map(|rest| rest.split(ends).next().unwrap().to_owned()).collect()
}

/// Names of types that stand in several files, with those files.
fn shared_names(modules: &[Module]) -> BTreeMap<String, Vec<String>> {
    let mut names: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for module in modules {
        for name in declared(&module.code) {
            names.entry(name).or_default().push(module.path.join("::"));
        }
    }
    names.retain(|_, files| files.len() > 1);
    names
}

/// Names of types that may stand in two or more files of `src`.
const MOST_SHARED_NAMES: usize = 25;

#[test]
fn few_types_share_a_name_and_none_in_one_room() {
    let modules = modules();
    let shared = shared_names(&modules);
    assert!(shared.len() <= MOST_SHARED_NAMES, "{} names stand in several files: {shared:#?}", shared.len());
    // Each subcommand has its `Arguments`.
    let in_one_room = |(name, files): &(&String, &Vec<String>)| {
        let rooms: BTreeSet<&str> = files.iter().filter_map(|file| file.split("::").next()).collect();
        rooms.len() < files.len() && name.as_str() != "Arguments"
    };
    let twice: Vec<_> = shared.iter().filter(in_one_room).collect();
    assert!(twice.is_empty(), "{twice:#?}");
}

#[test]
fn what_the_tests_of_the_order_look_for_is_found() {
    let module =
        |path: &str, code: &str| Module { path: path.split("::").map(str::to_owned).collect(), code: code.to_owned() };
    let modules = [
        module("a", "mod b;\nmod c;\npub use b::Named;\npub struct One;"),
        module("a::b", "use super::c::Other;\npub struct Named;"),
        module("a::c", "use crate::a::{One, Named};\npub struct Other;\nstruct One;"),
    ];
    let arrows = imports_between(&modules);
    assert_eq!(arrows, [BTreeSet::from([1]), BTreeSet::from([2]), BTreeSet::from([0, 1])]);
    assert_eq!(circles(&arrows).len(), 4);
    assert_eq!(circles(&[BTreeSet::from([1]), BTreeSet::new()]), []);
    assert_eq!(shared_names(&modules).into_keys().collect::<Vec<_>>(), ["One"]);
}
