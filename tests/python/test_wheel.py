# SPDX-License-Identifier: MIT
"""The wheel that carries its libraries: nothing of the system but the C library and the compiler's is loaded for it."""

import os
import pathlib
import shutil
import subprocess
import sys
import zipfile

import numpy
import pytest

from conftest import ROOT
import vantage

PACKAGE = pathlib.Path(vantage.__file__).parent
sys.path.insert(0, str(ROOT / "python"))
import carried_libraries  # noqa: E402

pytestmark = pytest.mark.skipif(shutil.which("patchelf") is None or shutil.which("dpkg") is None,
                                reason="NOTHING WAS TESTED: patchelf or dpkg is not installed")

# Prints every library that is mapped after the work and was not before it: NumPy's own are the system's.
LOOK = """
import numpy, sys
def mapped():
    return {line.split()[-1] for line in open("/proc/self/maps") if ".so" in line.split()[-1]}
before = mapped()
import vantage
result = vantage.best_view(sys.argv[1])
vantage.render(sys.argv[1], camera=result.best.camera, size=64)
print("\\n".join(sorted(mapped() - before)))
open("view.json", "w").write(result.json)
"""


@pytest.fixture(scope="module", name="wheel")
def carried_wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    done = subprocess.run(
        [sys.executable, ROOT / "python/make_wheel.py", PACKAGE, folder, "--version", vantage.__version__, "--summary",
         "A test", "--licence", ROOT / "LICENSE", "--notices", ROOT / "THIRD_PARTY.md", "--carry"],
        capture_output=True, text=True, check=True)
    return pathlib.Path(done.stdout.strip())


def test_it_is_small_and_says_what_it_needs(wheel):
    assert wheel.stat().st_size <= 40e6
    libc = os.confstr("CS_GNU_LIBC_VERSION").split()[1].replace(".", "_")
    assert wheel.name.endswith(f"-manylinux_{libc}_{os.uname().machine}.whl")


def test_every_library_has_its_licence(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        listed = archive.read(next(n for n in names if n.endswith("METADATA"))).decode()
    module = next(PACKAGE.glob("_core*.so"))
    for package, text in carried_libraries.licences_of(carried_libraries.loaded_by(module).values()).values():
        assert any(n.endswith(f".dist-info/licences/{package}") for n in names) and text
        assert f"License-File: licences/{package}\n" in listed
        if b"common-licenses/LGPL-3" in text:
            assert any(n.endswith("licences/common-licenses/LGPL-3") for n in names)


def test_it_runs_in_a_bare_environment_by_its_own_libraries(wheel, models, tmp_path):
    home = tmp_path / "venv"
    subprocess.run([sys.executable, "-m", "venv", home], check=True)
    # NumPy is the one thing it needs; here Debian's, as it is, in place of one from an index.
    site = next(home.glob("lib/python3*/site-packages"))
    (site / "numpy").symlink_to(pathlib.Path(numpy.__file__).parent)
    clean = {"PATH": "/usr/bin:/bin", "HOME": str(tmp_path)}
    subprocess.run([home / "bin/pip", "install", "--quiet", "--no-index", "--no-deps", wheel], env=clean, check=True)
    done = subprocess.run([home / "bin/python", "-c", LOOK, models / "cat_lowpoly.ply"], env=clean, cwd=tmp_path,
                          capture_output=True, text=True, check=True)
    loaded = done.stdout.split()
    assert sum("vantage.libs" in path for path in loaded) >= 10
    outside = [path for path in loaded if str(home) not in path
               and not carried_libraries.OF_THE_SYSTEM.match(pathlib.Path(path).name)
               and "lib-dynload" not in path]  # Python's own modules
    assert not outside
    assert (tmp_path / "view.json").read_text() == vantage.best_view(models / "cat_lowpoly.ply").json
