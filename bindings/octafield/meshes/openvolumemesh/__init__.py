"""Meshes of OpenVolumeMesh: text (.ovm) and binary (.ovmb)."""
