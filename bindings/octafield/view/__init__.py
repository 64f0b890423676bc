"""Pictures, scenes and plots, what notebooks show, and the objects of other packages."""
