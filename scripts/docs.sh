#!/usr/bin/env bash
# The documentation: build/site/index.html, pages that need no network.
#   scripts/docs.sh           builds them; a warning is an error
#   scripts/docs.sh serve     shows them while they are edited
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
make_venv requirements-docs.txt
install_octafield
export NO_MKDOCS_2_WARNING=1
if [ "${1:-}" = serve ]; then
    exec .venv/bin/python -m mkdocs serve --strict
fi
say "building build/site"
.venv/bin/python -m mkdocs build --strict --quiet
say "wrote build/site/index.html"
