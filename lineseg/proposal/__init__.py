"""Proposes thresholds that fit a laser, from its scans alone."""

from .search import LOWEST, Proposal, propose, rescaled, scaled

__all__ = ["LOWEST", "Proposal", "propose", "rescaled", "scaled"]
