//! The public functions that remain without the standard library, as the sources have them.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use syn::{Attribute, ImplItem, Item, TraitItem, Type, UseTree, Visibility};

/// Whether an item is there without the standard library, and for users.
fn is_there(attributes: &[Attribute]) -> bool {
    !attributes.iter().any(|attribute| {
        let words = match &attribute.meta {
            syn::Meta::List(list) if list.path.is_ident("cfg") => list.tokens.to_string(),
            _ => String::new(),
        };
        // A condition on what is missing keeps its item.
        !words.starts_with("not")
            && ["std", "report", "command", "internals", "test", "doc"].iter().any(|word| words.contains(word))
    })
}

fn is_public(visibility: &Visibility) -> bool {
    matches!(visibility, Visibility::Public(_))
}

/// Last names of what a `use` brings.
fn names(tree: &UseTree, into: &mut BTreeSet<String>) {
    match tree {
        UseTree::Path(path) => names(&path.tree, into),
        UseTree::Group(group) => group.items.iter().for_each(|tree| names(tree, into)),
        UseTree::Name(name) => drop(into.insert(name.ident.to_string())),
        UseTree::Rename(name) => drop(into.insert(name.rename.to_string())),
        UseTree::Glob(_) => {}
    }
}

#[derive(Default)]
struct Found {
    /// With the folder that they stand in.
    functions: BTreeSet<(String, String)>,
    /// Those in modules that only tests see by name: public where another module shows their type.
    hidden: BTreeSet<(String, String)>,
    /// Names that public modules show, and those that only tests see.
    shown: BTreeSet<String>,
    internal: BTreeSet<String>,
    inside: bool,
}

impl Found {
    fn file(&mut self, path: &Path, top: &str) {
        let source = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let file = syn::parse_file(&source).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        // `x/mod.rs` and `x.rs` both have their children in `x/`.
        let folder = if path.file_stem().is_some_and(|stem| stem == "mod" || stem == "lib") {
            path.parent().unwrap().to_owned()
        } else {
            path.with_extension("")
        };
        for item in &file.items {
            self.item(item, &folder, top);
        }
    }

    fn item(&mut self, item: &Item, folder: &Path, top: &str) {
        let mut add = |name: String| {
            let to = if self.inside { &mut self.hidden } else { &mut self.functions };
            to.insert((top.to_owned(), name));
        };
        match item {
            Item::Mod(module) if is_there(&module.attrs) => {
                let name = module.ident.to_string();
                let top = if top.is_empty() { &name } else { top };
                match &module.content {
                    Some((_, items)) => items.iter().for_each(|item| self.item(item, folder, top)),
                    None => {
                        let candidates: [PathBuf; 2] =
                            [folder.join(format!("{name}.rs")), folder.join(&name).join("mod.rs")];
                        let path =
                            candidates.iter().find(|path| path.exists()).unwrap_or_else(|| panic!("no file of {name}"));
                        self.file(path, top);
                    }
                }
            }
            Item::Fn(function) if is_there(&function.attrs) && is_public(&function.vis) => {
                add(function.sig.ident.to_string())
            }
            Item::Impl(block) if is_there(&block.attrs) && block.trait_.is_none() => {
                let Type::Path(named) = &*block.self_ty else { return };
                let of = named.path.segments.last().unwrap().ident.to_string();
                for item in &block.items {
                    if let ImplItem::Fn(function) = item
                        && is_there(&function.attrs)
                        && is_public(&function.vis)
                    {
                        add(format!("{of}::{}", function.sig.ident));
                    }
                }
            }
            Item::Trait(declared) if is_there(&declared.attrs) && is_public(&declared.vis) => {
                for item in &declared.items {
                    if let TraitItem::Fn(function) = item
                        && is_there(&function.attrs)
                    {
                        add(format!("{}::{}", declared.ident, function.sig.ident));
                    }
                }
            }
            Item::Use(shows) if !self.inside && is_there(&shows.attrs) && is_public(&shows.vis) => {
                names(&shows.tree, &mut self.shown);
            }
            Item::Macro(call) if call.mac.path.is_ident("internal") => {
                let outside = self.inside;
                self.inside = true;
                for item in &syn::parse2::<syn::File>(call.mac.tokens.clone()).unwrap().items {
                    if let Item::Use(hides) = item {
                        names(&hides.tree, &mut self.internal);
                    } else {
                        self.item(item, folder, top);
                    }
                }
                self.inside = outside;
            }
            _ => {}
        }
    }
}

/// Module and name of every public function: `Type::function`, `Trait::function` or `function`.
pub(super) fn functions() -> BTreeSet<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Found::default();
    found.file(&root.join("lib.rs"), "");
    let Found { functions, hidden, shown, internal, .. } = found;
    let of = |name: &str| name.split("::").next().unwrap().to_owned();
    let seen = hidden.into_iter().filter(|(_, name)| shown.contains(&of(name)));
    functions.into_iter().chain(seen).filter(|(_, name)| !internal.contains(&of(name))).collect()
}
