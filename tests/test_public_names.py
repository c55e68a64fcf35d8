"""The public names of the library, their list in the docstring, and their docstrings."""

import inspect
import re
import tomllib
from pathlib import Path

import pytest
from ruamel.yaml import YAML

import lineseg

ROOT = Path(__file__).parents[1]
NAMES = [name for name in lineseg.__all__ if not name.startswith("_")]


def test_the_docstring_of_the_package_lists_each_name_once():
    told = re.findall(r"`(\w+)`", lineseg.__doc__ or "")
    assert sorted(told) == sorted(NAMES)


@pytest.mark.parametrize("name", [name for name in NAMES if callable(getattr(lineseg, name))])
def test_each_name_has_a_docstring_of_its_own(name: str):
    thing = getattr(lineseg, name)
    own = vars(thing).get("__doc__") if inspect.isclass(thing) else thing.__doc__
    assert own
    # What dataclasses and NamedTuples write themselves says nothing.
    assert not own.startswith(f"{name}(")


def test_the_version_is_the_same_everywhere():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())
    assert project["project"]["dynamic"] == ["version"]
    assert project["tool"]["setuptools"]["dynamic"]["version"] == {"attr": "lineseg.writers.version.__version__"}
    assert YAML(typ="safe").load(ROOT / "CITATION.cff")["version"] == lineseg.__version__
    (newest, *_) = re.findall(r"^## (\S+)", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert newest == lineseg.__version__
