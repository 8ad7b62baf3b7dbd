//! The public functions that remain without the standard library, as the sources have them.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use syn::{Attribute, ImplItem, Item, TraitItem, Type, Visibility};

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

/// Identifiers between the braces of `use module::{...};` and after `mod` in `internal! { ... }`: names for tests only.
fn internal(tokens: &str) -> BTreeSet<String> {
    let words =
        |text: &str| text.split(|c: char| !(c.is_alphanumeric() || c == '_')).map(str::to_owned).collect::<Vec<_>>();
    let used = tokens
        .split("use ")
        .skip(1)
        .filter_map(|rest| rest.split_once('{')?.1.split_once('}'))
        .flat_map(|(names, _)| words(names));
    let declared = tokens.split("mod ").skip(1).filter_map(|rest| words(rest).into_iter().next());
    used.chain(declared).filter(|name| !name.is_empty()).collect()
}

#[derive(Default)]
struct Found {
    /// With the folder that they stand in.
    functions: BTreeSet<(String, String)>,
    internal: BTreeSet<String>,
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
            self.functions.insert((top.to_owned(), name));
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
            Item::Macro(call) if call.mac.path.is_ident("internal") => {
                self.internal.extend(internal(&call.mac.tokens.to_string()))
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
    let Found { mut functions, internal } = found;
    functions.retain(|(_, name)| !internal.contains(name.split("::").next().unwrap()));
    functions
}
