"""The domain of a field: what was read of a file or object, repaired, meshed and written, its features and regions."""
