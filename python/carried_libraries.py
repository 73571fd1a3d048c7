# SPDX-License-Identifier: MIT
"""The shared libraries that a wheel carries, so that it runs where none of them is installed.

Every library that the compiled part loads is copied, but those of the C library and of the compiler,
which every Linux with a C library as new as this one has. A copy has its hash in its name: a process
that has loaded another libtbb.so.12 already keeps its own. Needs patchelf, and dpkg for the licences.
"""
import hashlib
import os
import pathlib
import re
import subprocess

# What PEP 600 lets a wheel expect of the system; of its list, what this package loads.
OF_THE_SYSTEM = re.compile(r"(ld-linux-x86-64|libc|libm|libdl|librt|libpthread|libresolv|libgcc_s|libstdc\+\+)\.so\.")
FOLDER = "vantage.libs"


def output_of(*command):
    return subprocess.run(list(map(str, command)), check=True, capture_output=True, text=True).stdout


def loaded_by(module):
    """Paths of all libraries to carry, by the name that they are asked for; sorted."""
    found = dict(re.findall(r"^\s*(\S+) => (/\S+)", output_of("ldd", module), re.MULTILINE))
    missing = re.findall(r"^\s*(\S+) => not found", output_of("ldd", module), re.MULTILINE)
    if missing:
        raise SystemExit(f"make_wheel.py: {module} asks for {', '.join(missing)}, which is not installed")
    return {name: pathlib.Path(path) for name, path in sorted(found.items()) if not OF_THE_SYSTEM.match(name)}


def hashed_name(name, content):
    """libtbb.so.12 → libtbb-0123abcd.so.12."""
    stem, dot, rest = name.partition(".so")
    return f"{stem}-{hashlib.sha256(content).hexdigest()[:8]}{dot}{rest}"


def needed_by(binary):
    return output_of("patchelf", "--print-needed", binary).split()


def point_at_copies(binary, new_names, search_path, own_name=None):
    """Lets a binary find its libraries among the copies. One change a call: patchelf 0.14 loses the new names if it
    sets the search path with them."""
    replaced = [part for name in needed_by(binary) if name in new_names
                for part in ("--replace-needed", name, new_names[name])]
    for change in (replaced, ["--set-soname", own_name] if own_name else [],
                   ["--force-rpath", "--set-rpath", search_path]):
        if change:
            output_of("patchelf", *change, binary)
    left = set(needed_by(binary)) & set(new_names)
    if left:
        raise SystemExit(f"make_wheel.py: patchelf left {', '.join(sorted(left))} in {binary}")


def newest_symbol(binaries):
    """The version of the C library that they need at least, as (2, 36)."""
    symbols = "".join(output_of("objdump", "-T", binary) for binary in binaries)
    return max(tuple(map(int, version)) for version in re.findall(r"GLIBC_(\d+)\.(\d+)", symbols))


def licences_of(libraries):
    """Name and copyright file of the Debian package that each library is from, by the library's path."""
    places = {path: [str(p) for p in (path, path.resolve(), pathlib.Path("/usr" + str(path)))] for path in libraries}
    # One question for all: each reads the file lists of all packages.
    asked = ["dpkg", "-S", *sorted({place for some in places.values() for place in some})]
    answers = subprocess.run(asked, capture_output=True, text=True, check=False).stdout
    owners = {place: re.split("[:,]", owner)[0]
              for owner, _, place in (line.rpartition(": ") for line in answers.splitlines())}
    found = {}
    for path, some in places.items():
        package = next((owners[place] for place in some if place in owners), None)
        if package is None:
            raise SystemExit(f"make_wheel.py: no package owns {path}, so its licence is not known")
        found[path] = package, pathlib.Path("/usr/share/doc", package, "copyright").read_bytes()
    return found


def named_in(licences):
    """The licences that copyright files only point to, because every Debian system has them."""
    named = sorted({name.decode().rstrip(".") for text in licences.values()
                    for name in re.findall(rb"/usr/share/common-licenses/([A-Za-z0-9.-]+)", text)})
    files = {name: pathlib.Path("/usr/share/common-licenses", name) for name in named}
    return {f"common-licenses/{name}": file.read_bytes() for name, file in files.items() if file.exists()}


def carry(module, scratch):
    """Makes a copy of the module with all its libraries in the folder `scratch`.

    Returns the files of the wheel by name, the licences by package, and the platform tag. The tag names the C library
    of this machine: what was built here was tried with no older one."""
    folder = scratch / FOLDER
    folder.mkdir()
    libraries = loaded_by(module)
    new_names = {name: hashed_name(name, path.read_bytes()) for name, path in libraries.items()}
    copy = scratch / module.name
    copy.write_bytes(module.read_bytes())
    output_of("strip", "--strip-unneeded", copy)
    point_at_copies(copy, new_names, f"$ORIGIN/../{FOLDER}")
    for name, path in libraries.items():
        target = folder / new_names[name]
        target.write_bytes(path.read_bytes())
        point_at_copies(target, new_names, "$ORIGIN", new_names[name])
    here = tuple(map(int, os.confstr("CS_GNU_LIBC_VERSION").split()[1].split(".")[:2]))
    if newest_symbol([copy, *folder.iterdir()]) > here:
        raise SystemExit("make_wheel.py: a library needs a newer C library than this machine's")
    files = {f"vantage/{module.name}": copy.read_bytes()}
    files.update({f"{FOLDER}/{path.name}": path.read_bytes() for path in folder.iterdir()})
    licences = dict(sorted(licences_of(libraries.values()).values()))
    licences.update(named_in(licences))
    return files, licences, f"manylinux_{here[0]}_{here[1]}_{os.uname().machine}"
