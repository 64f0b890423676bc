"""What `octafield info` and `octafield doctor` tell: of a mesh before it is run, and of this installation."""
