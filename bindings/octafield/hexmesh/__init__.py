"""All-hex meshes from seamless maps: files of maps, the run, its figures and files."""
