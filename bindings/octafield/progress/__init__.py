"""What a run tells of itself: its phases, their seconds and memory, and the time left."""
