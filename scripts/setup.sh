# Sourced by the other scripts. From a bare Debian 12 (bash and apt) to octafield built and installed in .venv; quick when nothing is missing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

BUILD_DIR=build/release

say() { printf '\n== %s\n' "$*" >&2; }

# Runs a build, its output in build/build.log: every 10 seconds how many of Ninja's steps are done and the time. A failure shows the log's end.
build_with_progress() {
    local log=build/build.log line start=$SECONDS next=0 took left
    mkdir -p build
    if ! "$@" 2>&1 | while IFS= read -r line; do
        printf '%s\n' "$line" >&3
        [[ $line =~ ^[[:space:]]*\[([1-9][0-9]*)/([0-9]+)\] ]] || continue  # [0/2]: Ninja looks for new sources
        took=$((SECONDS - start))
        if [ "$took" -ge "$next" ] || [ "${BASH_REMATCH[1]}" = "${BASH_REMATCH[2]}" ]; then
            next=$((took + 10)) left=$((took * (BASH_REMATCH[2] - BASH_REMATCH[1]) / BASH_REMATCH[1]))
            printf '   [%d/%d] %d:%02d, about %d:%02d left\n' "${BASH_REMATCH[1]}" "${BASH_REMATCH[2]}" \
                $((took / 60)) $((took % 60)) $((left / 60)) $((left % 60)) >&2
        fi
    done 3>"$log"; then
        tail -n 60 "$log" >&2
        echo "the build failed; all of its output is in $log" >&2
        return 1
    fi
}

install_system_packages() {
    local wanted missing=() package
    wanted=$(sed 's/#.*//' scripts/packages.txt)
    for package in $wanted; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed' || missing+=("$package")
    done
    [ ${#missing[@]} -eq 0 ] && return
    say "installing ${#missing[@]} Debian packages"
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || { echo "missing Debian packages; run as root: apt-get install ${missing[*]}" >&2; exit 1; }
        as_root=(sudo)
    fi
    "${as_root[@]}" apt-get update -q >&2
    DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -q -y --no-install-recommends "${missing[@]}" >&2
}

# Pinned Python requirements, installed again only when a requirements file has changed.
make_venv() {
    [ -x .venv/bin/python ] || { say "creating .venv"; python3 -m venv .venv; }
    local file stamp
    for file in "$@"; do
        stamp=.venv/.$(basename "$file")
        cmp -s "$file" "$stamp" && continue
        say "downloading and installing the packages of $file (minutes, the first time)"
        build_with_progress .venv/bin/python -m pip install -v --disable-pip-version-check -r "$file" >&2
        cp "$file" "$stamp"
    done
}

# One build tree serves the Python package and the C++ tests, so that nothing is compiled twice.
install_octafield() {
    local stamp=.venv/.octafield
    if [ -e "$stamp" ] && [ -e "$BUILD_DIR/CMakeCache.txt" ] &&
        [ -z "$(find core frames surface volume bindings cmake CMakeLists.txt pyproject.toml -newer "$stamp" -print -quit)" ]; then
        return
    fi
    say "building octafield"
    touch "$stamp.new"
    build_with_progress .venv/bin/python -m pip install -v --disable-pip-version-check --no-build-isolation --no-deps \
        --config-settings=build-dir="$BUILD_DIR" . >&2
    mv "$stamp.new" "$stamp"
}

install_system_packages
make_venv requirements.txt
