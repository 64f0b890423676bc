"""Fields computed, analysed and scaled: from a meshed input to the record of its field."""
