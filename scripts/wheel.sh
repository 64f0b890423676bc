#!/usr/bin/env bash
# A wheel with the shared libraries it needs inside: dist/octafield-*.whl, for any Linux with glibc at least as new as this one's.
#   scripts/wheel.sh           builds it and tests it in a virtual environment of its own
#   scripts/wheel.sh --bare    also tests it in a Debian root that holds Python and nothing else (needs root and debootstrap)
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
make_venv requirements-wheel.txt
install_octafield

say "building the wheel"
mkdir -p build/wheel dist
rm -f build/wheel/*.whl dist/*.whl
.venv/bin/python -m pip wheel -q --disable-pip-version-check --no-build-isolation --no-deps --config-settings=build-dir="$BUILD_DIR" -w build/wheel .
glibc=$(getconf GNU_LIBC_VERSION)
PATH=$PWD/.venv/bin:$PATH .venv/bin/auditwheel repair --plat "manylinux_$(sed 's/.* //; s/\./_/' <<<"$glibc")_$(uname -m)" --only-plat -w dist build/wheel/*.whl 2>&1 | grep -v INFO: || true

# What a user does with it, in a folder that has nothing of ours. `compare` draws, `field` is the core.
check='set -e; cd "$(mktemp -d)"; python3 -m venv v; v/bin/pip install -q --disable-pip-version-check -c "$1"/requirements.txt "$1"/dist/*.whl
v/bin/octafield doctor; printf "name: w\ninputs: [{generator: box}]\nruns: {representation: [sh4, geodesic]}\n" > s.yaml
v/bin/octafield study run s.yaml -o out -q; test -s out/report.html; echo "the wheel works"'

say "testing the wheel in an empty virtual environment"
env -i HOME="$HOME" PATH=/usr/bin:/bin LANG=C.UTF-8 bash -c "$check" - "$PWD"

if [ "${1:-}" = --bare ]; then
    say "testing the wheel in a bare Debian root"
    root=$(mktemp -d)
    trap 'umount -l "$root/proc" 2>/dev/null || true; rm -rf --one-file-system "$root"' EXIT
    debootstrap --variant=minbase --include=ca-certificates,python3-venv bookworm "$root" >/dev/null
    mkdir -p "$root/wheel"
    cp -r dist requirements.txt "$root/wheel/"
    for file in /etc/pip.conf /etc/resolv.conf /etc/hosts /etc/ssl/certs/ca-certificates.crt; do
        [ -f "$file" ] && cp -L "$file" "$root$file"
    done
    mount -t proc proc "$root/proc"
    chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/bin:/bin:/usr/sbin:/sbin LANG=C.UTF-8 bash -c "$check" - /wheel
fi
