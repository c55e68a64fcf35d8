"""The version of this package, which written files name, and which the build reads without importing the rest."""

__version__ = "0.1.0"
