"""The bodies that the word `generator` of a study's file stands for."""

from ..domain.generators import GENERATORS, generate

__all__ = ["GENERATORS", "generate"]
