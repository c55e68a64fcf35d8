"""Files import one another in one direction, also where a function imports, and functions are short."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

import lineseg_app

import lineseg

ROOTS = {"lineseg": Path(lineseg.__file__).parent, "lineseg_app": Path(lineseg_app.__file__).parent}
# What can be, or contain, an import.
NESTS = ast.stmt, ast.excepthandler, ast.match_case


@cache
def files() -> dict[str, Path]:
    """Each module's file."""
    found = {}
    for package, root in ROOTS.items():
        for path in root.rglob("*.py"):
            parts = path.relative_to(root).with_suffix("").parts
            found[".".join((package, *parts)).removesuffix(".__init__")] = path
    return found


def for_types_alone(node: ast.AST) -> bool:
    return isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"


def walk(tree: ast.AST) -> Iterator[ast.AST]:
    left = [tree]
    while left:
        node = left.pop()
        yield node
        # No expression imports.
        left += [
            child for child in ast.iter_child_nodes(node) if isinstance(child, NESTS) and not for_types_alone(child)
        ]


@cache
def imports() -> dict[str, set[str]]:
    """The modules of the project that each module imports."""
    return {module: set(imported_by(module, path)) - {module} for module, path in files().items()}


def imported_by(module: str, path: Path) -> Iterator[str]:
    package = module.split(".") if path.name == "__init__.py" else module.split(".")[:-1]
    for node in walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            named = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else []
            source = ".".join([*base, *filter(None, [node.module])])
            named = [each if (each := f"{source}.{alias.name}") in files() else source for alias in node.names]
        else:
            continue
        yield from (name for name in named if name in files())


def test_no_file_imports_what_imports_it():
    # It raises CycleError, which names the circle.
    order = list(TopologicalSorter(imports()).static_order())
    assert len(order) > 300


def test_no_folder_imports_what_imports_it():
    """So the folders stand in an order, and no import runs back up. A file at the root stands for itself."""
    folders: dict[str, set[str]] = {}
    for name, imported in imports().items():
        folder = folder_of(name)
        folders.setdefault(folder, set()).update({folder_of(other) for other in imported} - {folder})
    order = list(TopologicalSorter(folders).static_order())
    assert len(order) > 40


def folder_of(module: str) -> str:
    return ".".join(module.split(".")[:2])


def test_the_library_does_not_import_the_application():
    assert [
        name
        for name, imported in imports().items()
        if name.split(".")[0] == "lineseg" and any(other.startswith("lineseg_app") for other in imported)
    ] == []


def test_a_newcomer_sees_twenty_files_or_fewer_at_each_root():
    counts = {package: len(list(root.glob("[!_]*.py"))) for package, root in ROOTS.items()}
    assert {package: count for package, count in counts.items() if count > 20} == {}


def test_no_function_has_more_than_sixty_lines():
    long = {}
    for name, path in files().items():
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                assert node.end_lineno is not None
                long[f"{name}.{node.name}"] = node.end_lineno - node.lineno + 1
    assert {name: lines for name, lines in long.items() if lines > 60} == {}
