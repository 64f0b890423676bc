"""The laws that schemes of one's own obey, as classes of tests for pytest:

    from octafield.laws import EmbeddingLaws
    from mine import scheme

    class TestMine(EmbeddingLaws):
        scheme = scheme

Each test says in its message which frames break the law. tolerance: of equal vectors, beside the largest of them.
"""

from .schemes import EdgeLaws, EmbeddingLaws

__all__ = ["EdgeLaws", "EmbeddingLaws"]
