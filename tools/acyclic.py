"""Fail on a circle of imports among the files of a crate, or among the folders that hold them.

It reads the `use` statements and the paths of the crates. A name counts for the file that defines
it: a file that only passes it on (`pub use`) is no dependency. Within a folder, its files and its
folders must be without a circle too, each folder taken as one. `lint-imports` does the same for the
package of Python.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

Graph = dict[Path, set[Path]]
Name = tuple[str, ...]

ITEM = re.compile(
    r"\b(?:struct|enum|union|trait|type|fn|const|static|macro_rules!)\s+(?:mut\s+)?([A-Za-z_]\w*)"
)
USE = re.compile(r"\b(pub(?:\([^)]*\))?\s+)?use\s+([^;]+);")
PATH = re.compile(r"(?<![\w:])[A-Za-z_]\w*(?:::[A-Za-z_]\w*)+")
VISIBILITY = re.compile(r"\bpub\(in [^)]*\)")
TEST_MODULE = re.compile(
    r"#\[cfg\(test\)\]\s*(?:#\[[^\]]*\]\s*)*(?:pub(?:\([^)]*\))?\s+)?mod\s+\w+\s*(;|\{)"
)
NOT_CODE = re.compile(
    r'//[^\n]*|/\*.*?\*/|r#*".*?"#*|"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])\'', re.DOTALL
)


def code_of(file: Path) -> str:
    """A Rust file without comments, literals and tests."""
    text = VISIBILITY.sub("pub", NOT_CODE.sub(" ", file.read_text()))
    while found := TEST_MODULE.search(text):
        end = found.end()
        depth = 1 if found[1] == "{" else 0
        while depth:
            depth += {"{": 1, "}": -1}.get(text[end], 0)
            end += 1
        text = text[: found.start()] + text[end:]
    return text


def leaves(tree: str) -> list[tuple[Name, str]]:
    """The paths of a `use` tree, each with the name that it gets."""
    tree = tree.strip()
    if "{" not in tree:
        path, _, alias = (part.strip() for part in tree.partition(" as "))
        names = tuple(name.strip() for name in path.split("::"))
        names = names[:-1] if names[-1] == "self" and len(names) > 1 else names
        return [(names, alias or names[-1])]
    head, _, rest = tree.partition("{")
    before = tuple(name.strip() for name in head.split("::") if name.strip())
    parts, depth, start = [], 0, 0
    inner = rest[: rest.rindex("}")]
    for at, sign in enumerate(inner):
        depth += {"{": 1, "}": -1}.get(sign, 0)
        if sign == "," and depth == 0:
            parts.append(inner[start:at])
            start = at + 1
    parts.append(inner[start:])
    found = []
    for part in filter(str.strip, parts):
        for path, alias in leaves(part):
            whole = before if path == ("self",) else before + path
            found.append((whole, before[-1] if path == ("self",) else alias))
    return found


class Crate:
    """The modules of a crate: files, items and what they import."""

    def __init__(self, src: Path) -> None:
        self.files: dict[Name, Path] = {}
        self.code: dict[Name, str] = {}
        self.items: dict[Name, set[str]] = {}
        self.uses: dict[Name, list[tuple[Name, str, bool]]] = {}
        for file in sorted(src.rglob("*.rs")):
            name = file.relative_to(src).with_suffix("").parts
            if name[-1] in ("mod", "lib", "main"):
                name = name[:-1]
            if "tests" not in name:
                self.files[name] = file
        for name, file in self.files.items():
            code = code_of(file)
            uses = [
                (path, alias, bool(use[1]))
                for use in USE.finditer(code)
                for path, alias in leaves(use[2])
            ]
            self.uses[name], self.code[name] = uses, USE.sub(" ", code)
            self.items[name] = set(ITEM.findall(code))

    def absolute(self, module: Name, path: Name) -> Name | None:
        """A path as seen from a module, from the root; None if it leads out of the crate."""
        at = module
        if path[0] == "crate":
            at, path = (), path[1:]
        elif path[0] in ("self", "super"):
            while path and path[0] in ("self", "super"):
                at, path = (at[:-1] if path[0] == "super" else at), path[1:]
        elif module + path[:1] not in self.files:
            return None
        return at + path

    def defined(self, path: Name, seen: frozenset[Name] = frozenset()) -> Path | None:
        """The file that defines what an absolute path names."""
        module = path
        while module not in self.files:
            module = module[:-1]
        if module == path:
            return self.files[module]
        item = path[len(module)]
        if item in self.items[module] or path in seen:
            return self.files[module]
        for target, alias, _ in self.uses[module]:
            to = self.absolute(module, target)
            if to is None or alias not in (item, "*"):
                continue
            if alias == "*":
                to = (*to[:-1], item)
                if to[:-1] not in self.files or not self.holds(to):
                    continue
            return self.defined(to + path[len(module) + 1 :], seen | {path})
        return self.files[module]

    def holds(self, path: Name) -> bool:
        """Whether a module has an item of its own or hands it on."""
        *module, item = path
        names = (alias for _, alias, _ in self.uses[tuple(module)])
        return item in self.items[tuple(module)] or item in names

    def dependencies(self) -> Graph:
        """Which files each file imports from."""
        graph: Graph = {file: set() for file in self.files.values()}
        for module, file in self.files.items():
            code = self.code[module]
            paths: list[Name] = []
            aliases: dict[str, Name] = {}
            for path, alias, public in self.uses[module]:
                to = self.absolute(module, path)
                if to is None:
                    continue
                if path[-1] == "*":
                    to = to[:-1]
                aliases[alias] = to
                if not public or re.search(rf"\b{re.escape(alias)}\b", code):
                    paths.append(to)
            for found in PATH.findall(code):
                path = tuple(found.split("::"))
                to = aliases.get(path[0])
                absolute = to + path[1:] if to else self.absolute(module, path)
                if absolute is not None:
                    paths.append(absolute)
            graph[file] |= {to for path in paths if (to := self.defined(path))}
            graph[file].discard(file)
        return graph


def circles(graph: Graph) -> list[list[Path]]:
    """The shortest circle through each knot of a graph."""
    found, done = [], set()
    for start in sorted(graph):
        if start in done:
            continue
        before: dict[Path, Path] = {}
        edge = [start]
        while edge and start not in before:
            after = []
            for node in edge:
                for to in sorted(graph.get(node, ())):
                    if to not in before:
                        before[to] = node
                        after.append(to)
            edge = after
        if start in before:
            circle = [start]
            while (node := before[circle[-1]]) != start:
                circle.append(node)
            done.update(circle)
            found.append([start, *reversed(circle)])
    return found


def folded(graph: Graph, folder: Path) -> Graph:
    """The graph of the entries of a folder, each folder in it taken as one."""
    depth = len(folder.parts) + 1
    entries: Graph = {}
    for file, targets in graph.items():
        if folder in file.parents:
            entry = Path(*file.parts[:depth])
            inside = {Path(*to.parts[:depth]) for to in targets if folder in to.parents}
            entries.setdefault(entry, set()).update(inside - {entry})
    return entries


def main() -> int:
    """Prints every circle; 1 if there is one."""
    root = Path(__file__).parent.parent
    bad = 0
    crates = sorted(root.glob("crates/*/src"))
    for src in crates:
        graph = Crate(src).dependencies()
        of_files = circles(graph)
        folders = sorted(
            {
                folder
                for file in graph
                for folder in file.parents
                if src in (folder, *folder.parents)
            }
        )
        of_folders = [
            circle
            for folder in folders
            for circle in circles(folded(graph, folder))
            if any(entry.is_dir() for entry in circle)
        ]
        for circle in of_files + of_folders:
            print(
                "circle:",
                " -> ".join(str(entry.relative_to(src)) for entry in circle),
                f"({src.relative_to(root)})",
            )
        bad += len(of_files) + len(of_folders)
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())
