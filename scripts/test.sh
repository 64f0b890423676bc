#!/usr/bin/env bash
# All tests: C++ (ctest), an outside CMake project that uses the installed package, Python (pytest).
#   scripts/test.sh              everything
#   scripts/test.sh --sanitize   the C++ tests with AddressSanitizer and UndefinedBehaviorSanitizer, in a build tree of their own
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
jobs=$(nproc)

if [ "${1:-}" = --sanitize ]; then
    say "building with sanitizers"
    cmake -S . -B build/sanitize -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" -DOCTAFIELD_PYTHON=OFF -DOCTAFIELD_TESTS=ON \
        -DOCTAFIELD_SANITIZE=address,undefined -DOCTAFIELD_CONSUMER_TEST=OFF -DOCTAFIELD_PCH=OFF -DOCTAFIELD_UNITY=OFF >/dev/null
    build_with_progress cmake --build build/sanitize
    ctest --test-dir build/sanitize --output-on-failure -j "$jobs"
    exit
fi

make_venv requirements-test.txt requirements-docs.txt
install_octafield
say "building the C++ tests and benchmarks"
cmake -S . -B "$BUILD_DIR" -DOCTAFIELD_TESTS=ON -DOCTAFIELD_BENCHMARKS=ON >/dev/null
build_with_progress cmake --build "$BUILD_DIR"
say "C++ tests"
ctest --test-dir "$BUILD_DIR" --output-on-failure -j "$jobs"
say "Python tests"
.venv/bin/python -m pytest -q --durations=20 -n logical --maxprocesses=4 --dist worksteal
