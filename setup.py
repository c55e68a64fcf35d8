"""Which folders are installed, and as what; all else is in pyproject.toml."""

from setuptools import find_packages, setup

DATA = {"lineseg_app.static": "static", "lineseg_app.sample_scans": "sample_scans"}

setup(
    packages=[
        *find_packages(include=["lineseg", "lineseg.*"]),
        "lineseg_app",
        *(f"lineseg_app.{room}" for room in find_packages("app")),
        *DATA,
    ],
    package_dir={"lineseg_app": "app", **DATA},
    package_data={"": ["py.typed", "*.md", "*.pyi"], **{name: ["**/*"] for name in DATA}},
    include_package_data=False,
)
