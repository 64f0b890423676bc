"""What a run leaves in JSON: a model per kind of record, read and written in one place."""
