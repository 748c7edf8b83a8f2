#!/usr/bin/env python3
"""Checks what the compiler cannot: that the tree keeps to its floor plan and to docs/style.md.

    floors.py ROOT          prints one line a violation, exit code 1 if there is any
    floors.py --self-test   plants one violation of each rule in a small tree and checks that it is found
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

MAX_LINES = 400
CODE = (".h", ".cpp")
LIST_KEYWORDS = ("DEPS", "LINK", "PUBLIC_LINK", "HEADERS", "SOURCES")
# Third-party headers that only the named floors may see.
RESTRICTED = {"embree3/": ("common/scene/",), "embree4/": ("common/scene/",), "OpenEXR/": ("common/image/", "common/scene/")}
MACHINE_PATHS = ("/" + "work/", "/" + "root/")


def tracked_files(root):
    """Paths relative to root that git knows or would add; all files where root is not a checkout."""
    command = ["git", "-c", "safe.directory=*", "-C", str(root), "ls-files", "-z", "--cached", "--others",
               "--exclude-standard"]
    listing = subprocess.run(command, capture_output=True, check=False) if (root / ".git").exists() else None
    if listing and listing.returncode == 0:
        names = [name for name in listing.stdout.decode().split("\0") if name]
    else:
        names = [str(path.relative_to(root)) for path in root.rglob("*")]
    names = [name for name in names if not name.startswith((".git/", "build/", "out/")) and (root / name).is_file()]
    return sorted(names)


def text_of(path):
    """The file's text; empty for binary files."""
    content = path.read_bytes()
    return "" if b"\0" in content else content.decode("utf-8", "replace")


def cmake_code(path):
    return re.sub(r"#[^\n]*", "", text_of(path)) if path.is_file() else ""


def modules(root):
    """Module name -> the lists of its radfarm_module call."""
    found = {}
    for path in sorted((root / "common").glob("*/CMakeLists.txt")):
        for call in re.findall(r"radfarm_module\(([^)]*)\)", cmake_code(path)):
            lists, current, name = {key: [] for key in LIST_KEYWORDS}, None, None
            for word in call.split():
                if word == "NAME" or word in LIST_KEYWORDS:
                    current = word
                elif current == "NAME":
                    name = word
                elif current:
                    lists[current].append(word)
            found[name] = lists
    return found


def includes(text):
    for number, line in enumerate(text.splitlines(), 1):
        match = re.match(r'\s*#\s*include\s*(["<])([^">]+)[">]', line)
        if match:
            yield number, match.group(1) == '"', match.group(2)


def check_includes(name, text, plan):
    parts = name.split("/")
    own = parts[1] if parts[0] == "common" and len(parts) > 2 else None
    for number, quoted, header in includes(text):
        place = f"{name}:{number}: "
        if quoted and ("../" in header or header.startswith("/")):
            yield place + f'include "{header}" is not relative to the include root'
        for prefix, floors in RESTRICTED.items():
            if header.startswith(prefix) and parts[0] in ("common", "services") and not name.startswith(floors):
                yield place + f"{prefix[:-1]} may be included only under {' and '.join(floors)}"
        target = header.split("/")[0]
        if quoted and own and target in plan and target != own and target not in plan.get(own, {}).get("DEPS", []):
            yield place + f"{own} includes {target}, not in its DEPS"
        if quoted and parts[0] == "common" and target in ("coordinator", "worker", "cli", "services"):
            yield place + f"common includes {header}, which is a service's"


def check_listed(root, name, plan):
    """Every file of a module is one of its HEADERS or SOURCES, every test is in the CMakeLists.txt of its folder."""
    path = Path(name)
    parts = path.parts
    if path.suffix in CODE and parts[0] == "common" and len(parts) == 3 and parts[1] in plan:
        lists = plan[parts[1]]
        if path.name not in lists["HEADERS"] + lists["SOURCES"]:
            yield f"{name}: is not listed in common/{parts[1]}/CMakeLists.txt"
    if parts[0] == "tests" and name.endswith("_test.cpp"):
        folder = root / path.parent
        words = cmake_code(folder / "CMakeLists.txt").split() + cmake_code(folder.parent / "CMakeLists.txt").split()
        if not {path.name, f"{folder.name}/{path.name}"} & {word.strip("()") for word in words}:
            yield f"{name}: no CMakeLists.txt compiles it"


def check_mirror(root, name):
    """tests/unit/<module>/<x>_test.cpp has its common/<module>/<x>.{h,cpp} or services/<module>/<x>.{h,cpp}."""
    match = re.fullmatch(r"tests/unit/(\w+)/(\w+)_test\.cpp", name)
    if not match:
        return
    module, stem = match.groups()
    if not any((root / floor / module / (stem + suffix)).is_file() for floor in ("common", "services") for suffix in CODE):
        yield f"{name}: there is no common/{module}/{stem}.h or .cpp that it could test"


def check(root):
    plan = modules(root)
    violations = []
    for name in tracked_files(root):
        text = text_of(root / name)
        for number, line in enumerate(text.splitlines(), 1):
            if any(path in line for path in MACHINE_PATHS):
                violations.append(f"{name}:{number}: names a path of one machine")
        if not name.endswith(CODE + (".py", ".sh", ".proto")):
            continue
        lines = text.count("\n")
        if lines > MAX_LINES:
            violations.append(f"{name}: has {lines} lines, at most {MAX_LINES}")
        if name.endswith(CODE):
            violations += check_includes(name, text, plan)
            violations += check_listed(root, name, plan)
            violations += check_mirror(root, name)
    return violations


CLEAN_TREE = {
    "common/base/CMakeLists.txt": "radfarm_module(NAME base HEADERS a.h b.h)",
    "common/base/a.h": "#pragma once\n",
    "common/base/b.h": '#include "base/a.h"\n',
    "common/math/CMakeLists.txt": "radfarm_module(NAME math\n  DEPS base # below\n  HEADERS v.h\n  SOURCES v.cpp)",
    "common/math/v.h": '#include "base/a.h"\n#include <vector>\n',
    "common/math/v.cpp": '#include "math/v.h"\n',
    "services/cli/main.cpp": '#include "math/v.h"\n',
    "tests/unit/math/CMakeLists.txt": "radfarm_test(KIND unit NAME math SOURCES v_test.cpp)",
    "tests/unit/math/v_test.cpp": '#include "math/v.h"\n',
}
# What is planted, and a part of the line that must report it.
PLANTED = [
    ({"common/base/a.h": '#include "math/v.h"\n'}, "common/base/a.h:1: base includes math, not in its DEPS"),
    ({"common/base/a.h": '#include "cli/main.h"\n'}, "which is a service's"),
    ({"common/math/v.h": '#include "../base/a.h"\n'}, "is not relative to the include root"),
    ({"common/math/v.h": "#include <embree3/rtcore.h>\n"}, "embree3 may be included only under"),
    ({"services/cli/main.cpp": "#include <OpenEXR/ImfHeader.h>\n"}, "OpenEXR may be included only under"),
    ({"common/math/v.cpp": "//\n" * (MAX_LINES + 1)}, "has 401 lines"),
    ({"common/math/w.cpp": "//\n"}, "is not listed in common/math/CMakeLists.txt"),
    ({"tests/unit/math/CMakeLists.txt": "# v_test.cpp\n"}, "no CMakeLists.txt compiles it"),
    ({"tests/unit/math/CMakeLists.txt": "radfarm_test(SOURCES v_test.cpp w_test.cpp)", "tests/unit/math/w_test.cpp": "\n"},
     "there is no common/math/w.h"),
    ({"docs/a.md": "see " + MACHINE_PATHS[0] + "main\n"}, "docs/a.md:1: names a path of one machine"),
]


def violations_of(files):
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for name, content in files.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(content)
        return check(root)


def self_test():
    failures = [f"clean tree: {line}" for line in violations_of(CLEAN_TREE)]
    for files, expected in PLANTED:
        found = violations_of(CLEAN_TREE | files)
        if len(found) != 1 or expected not in found[0]:
            failures.append(f"planted '{expected}', found {found}")
    return failures


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    problems = self_test() if sys.argv[1] == "--self-test" else check(Path(sys.argv[1]).resolve())
    print("\n".join(problems))
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
