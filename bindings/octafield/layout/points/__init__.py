"""Singular points and corners that layouts are made for: from files, fields of crosses, or lines at any angle."""
