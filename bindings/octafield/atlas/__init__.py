"""Surfaces as one-to-one charts."""
