"""A function of the project that is used and defined nowhere fails the build of the compiled module, not its import."""

import shutil
import subprocess
from pathlib import Path

SCRIPT = Path(__file__).parents[2] / "cmake" / "require_defined.cmake"
TOOLS = {name: shutil.which(name) for name in ("g++", "nm", "cmake")}


def checked(folder, source):
    library = folder / "module.so"
    (folder / "source.cpp").write_text(source)
    subprocess.run(["g++", "-shared", "-fPIC", "-o", library, folder / "source.cpp"], check=True)
    arguments = [f"-DNM={TOOLS['nm']}", f"-DLIBRARY={library}", "-P", SCRIPT]
    done = subprocess.run(["cmake", *arguments], capture_output=True, text=True)
    return done, library.exists()


def test_what_python_defines_may_be_missing_and_what_the_project_should_may_not(tmp_path):
    done, there = checked(tmp_path, 'extern "C" int PyList_New(int); int f() { return PyList_New(0); }')
    assert done.returncode == 0 and there
    template = (
        "namespace octafield { template <class R> int solve(R); struct Sh6 {}; int f() { return solve(Sh6()); } }"
    )
    done, there = checked(tmp_path, template)
    assert done.returncode != 0 and not there
    assert "int octafield::solve<octafield::Sh6>(octafield::Sh6)" in done.stderr
