#!/usr/bin/env bash
# The main job: installs what is missing, builds, compares frame fields on a closed surface or tet mesh, and writes a report.
#   scripts/compare.sh [MESH...] [options of `octafield compare`]
# Without MESH: the nut that comes with pyvista. Without -o: the folder out/compare.
caller=$PWD
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
install_octafield
root=$PWD
cd "$caller"
case " $* " in
    *" -o "* | *" --output "* | *" --output="* | *" --help "*) ;;
    *) set -- "$@" -o "$root/out/compare" ;;
esac
exec "$root/.venv/bin/octafield" compare "$@"
