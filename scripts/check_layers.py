#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Refuses includes that docs/architecture.md does not allow; run as a test. Exit code 1 lists them."""
import pathlib
import re
import sys

# module -> modules it may include, itself and what is below understood
ALLOWED = {
    "core": "",
    "mesh": "core",
    "io": "core mesh",
    "spatial": "core mesh",
    "operators": "core mesh spatial",
    "contraction": "core mesh spatial operators",
    "skeleton": "core mesh spatial contraction",
    "visibility": "core mesh spatial",
    "significance": "core mesh spatial contraction skeleton",
    "view": "core mesh spatial significance visibility",
    "orientation": "core mesh spatial",
    "choice": "core mesh spatial",
    "render": "core mesh spatial",
    "pipeline": "core mesh io spatial operators contraction skeleton visibility significance view orientation choice render",
    "report": "core mesh io spatial operators contraction skeleton visibility significance view orientation choice render pipeline",
}
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


def module_of(include):
    """Module that an include path names; None for files of the same folder."""
    parts = include.removeprefix("vantage/").split("/")
    return parts[0] if len(parts) > 1 else None


def problems_of(root):
    needed = {module: set() for module in ALLOWED}
    for folder in ("include/vantage", "src"):
        for file in sorted((root / folder).rglob("*")):
            if file.suffix not in (".h", ".cpp", ".in"):
                continue
            module = file.relative_to(root / folder).parts[0]
            name = file.relative_to(root)
            if module not in ALLOWED:
                yield f"{name}: module {module} is not in the table of {pathlib.Path(__file__).name}"
                continue
            for include in INCLUDE.findall(file.read_text(encoding="utf-8")):
                target = module_of(include)
                needed[module].add(target)
                if target is None:
                    yield f'{name}: include "{include}" by its full path'
                elif target != module and target not in ALLOWED[module].split():
                    yield f"{name}: {module} must not include {include}"
                elif folder.startswith("include") and not include.startswith("vantage/"):
                    yield f"{name}: a public header includes the private {include}"
    for module, targets in needed.items():
        may = set(ALLOWED[module].split())
        all_above = len(may) == list(ALLOWED).index(module)
        for target in sorted(may - targets) if not all_above else ():
            yield f"{pathlib.Path(__file__).name}: {module} may include {target}, but does not"
    outside = [*(root / "apps").rglob("*.[ch]*"), *(root / "python").rglob("*.[ch]*")]
    for file in sorted(outside):
        for include in INCLUDE.findall(file.read_text(encoding="utf-8")):
            if "/" in include and (root / "src" / include).exists():
                yield f"{file.relative_to(root)}: what is outside the library includes the private {include}"


def differences_from_page(root):
    """Rows of docs/architecture.md, | `module` | what | may include |, that differ from the table."""
    page, above = {}, []
    text = (root / "docs/architecture.md").read_text(encoding="utf-8")
    for module, may in re.findall(r"^\| `(\w+)` \|[^|]*\|([^|]*)\|$", text, re.MULTILINE):
        page[module] = set(above if "all of the above" in may else re.findall(r"\w+", may))
        above.append(module)
    for module in sorted(ALLOWED.keys() | page.keys()):
        if module not in ALLOWED or page.get(module) != set(ALLOWED[module].split()):
            yield f"docs/architecture.md and {pathlib.Path(__file__).name} differ about {module}"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    problems = [*problems_of(root), *differences_from_page(root)]
    print("\n".join(problems) or "all includes are allowed")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
