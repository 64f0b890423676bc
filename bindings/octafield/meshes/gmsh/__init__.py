"""What Gmsh reads and writes: its mesh files, and CAD files that it meshes in a process of its own."""
