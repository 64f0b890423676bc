"""What a run tells of itself: its phases, their seconds and memory; several runs as one."""
