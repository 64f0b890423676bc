"""Bytes and folders: read packed or not, written whole or not at all."""
