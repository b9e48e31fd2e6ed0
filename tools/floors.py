#!/usr/bin/env python3
"""Enforces the floors of docs/floors.toml and the habits of CONTRIBUTING.md: tools/floors.py [ROOT]."""
# SPDX-License-Identifier: MIT
import json
import os
import re
import subprocess
import sys
import tomllib
from collections import defaultdict

CODE = (".h", ".cpp", ".inl")
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')
FOLDERS = ("src/meshreel", "cli", "bindings", "wasm", "lab", "bench", "tests", "fuzz")
MACHINE_PATH = re.compile(r"/(?:home|root|Users)/[a-z]|/tmp/[a-z]{2,}/|/wor[k]/")


def tracked(root):
    """Every file of the project: git's, or without git all that are not in a build folder."""
    listing = subprocess.run(["git", "-C", root, "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                             capture_output=True, text=True)
    if listing.returncode == 0:
        return sorted(p for p in listing.stdout.split("\0") if p and os.path.isfile(os.path.join(root, p)))
    found = []
    for folder, folders, names in os.walk(root):
        folders[:] = [f for f in folders if not f.startswith(("build", ".")) and f != "node_modules"]
        found += [os.path.relpath(os.path.join(folder, n), root) for n in names]
    return sorted(found)


def room_of(path):
    """The room a file lives in: 'base' of src/meshreel/base/id.h, 'meshreel' for the front door, 'cli', 'tests' ..."""
    parts = path.split("/")
    if path.startswith("src/meshreel/"):
        return parts[2] if len(parts) > 3 else "meshreel"
    return parts[0]


class House:
    def __init__(self, root):
        self.root = root
        with open(os.path.join(root, "docs/floors.toml"), "rb") as file:
            self.rules = tomllib.load(file)
        self.floor = {room: n for n, rooms in enumerate(self.rules["floors"]) for room in rooms}
        self.files = tracked(root)
        self.code = [p for p in self.files if p.endswith(CODE) and p.startswith(FOLDERS)]
        self.text = {p: self.read(p) for p in self.code}
        self.complaints = []

    def read(self, path):
        with open(os.path.join(self.root, path), encoding="utf-8", errors="replace") as file:
            return file.read()

    def complain(self, path, line, sentence):
        self.complaints.append(f"{path}:{line}: {sentence}")

    def includes(self, path):
        for number, line in enumerate(self.text[path].splitlines(), 1):
            if match := INCLUDE.match(line):
                yield number, match[1]

    def check_first_lines(self):
        for path in self.code:
            lines = self.text[path].splitlines() + ["", ""]
            if not re.match(r"/// \S.*[.:]$|/// \S.{15,}", lines[0]):
                self.complain(path, 1, "the first line does not state the file's purpose (/// one sentence)")
            if lines[1] != "// SPDX-License-Identifier: MIT":
                self.complain(path, 2, "the second line is not // SPDX-License-Identifier: MIT")
        for path in self.files:
            if path.endswith((".sh", ".py")) and "SPDX-License-Identifier: MIT" not in self.read(path)[:600]:
                self.complain(path, 1, "no SPDX-License-Identifier: MIT among the first lines")

    def check_arrows(self):
        outside = self.rules["outside"]
        for path in self.code:
            here = room_of(path)
            if here not in self.floor and here not in outside:
                self.complain(path, 1, f"the room {here} stands on no floor of docs/floors.toml")
                continue
            for line, wanted in self.includes(path):
                self.check_library(path, line, wanted)
                there = self.room_included(path, wanted)
                if there is None or there == here or here in outside:
                    continue
                if there in outside:
                    self.complain(path, line, f"{here} includes {wanted}, which is outside the house")
                elif there not in self.floor:
                    self.complain(path, line, f"{wanted} stands on no floor of docs/floors.toml")
                elif self.floor[there] >= self.floor[here]:
                    kind = "a neighbour" if self.floor[there] == self.floor[here] else "upstairs"
                    self.complain(path, line, f"{here} (floor {self.floor[here]}) includes {wanted}: {kind}")

    def check_library(self, path, line, wanted):
        for library, rooms in self.rules["libraries"].items():
            if wanted.startswith(library) and room_of(path) not in rooms:
                self.complain(path, line, f"only {', '.join(rooms)} may include {library}")

    def target(self, path, wanted):
        """The project's file that an include names, or None for one from outside."""
        for candidate in (os.path.join("src", wanted), wanted, os.path.join(os.path.dirname(path), wanted)):
            candidate = os.path.normpath(candidate)
            if candidate in self.text:
                return candidate
        return None

    def room_included(self, path, wanted):
        target = self.target(path, wanted)
        if target is None and wanted.startswith("meshreel/"):
            self.complain(path, 1, f"{wanted} does not exist")
        return room_of(target) if target else None

    def check_circles(self):
        edges = {p: {t for _, w in self.includes(p) if (t := self.target(p, w)) and t != p} for p in self.code}
        folder = os.path.dirname
        pairs = {(folder(a), folder(b)) for a in edges for b in edges[a] if folder(a) != folder(b)}
        for a, b in sorted(pairs):
            related = a.startswith(b + "/") or b.startswith(a + "/")  # a folder and its own child may talk
            if a < b and (b, a) in pairs and not related:
                self.complaints.append(f"{a} and {b} include each other")
        for circle in circles(edges):
            self.complaints.append("these files include each other in a circle: " + ", ".join(sorted(circle)))

    def check_sizes(self):
        limits = self.rules["limits"]
        for path in self.code:
            lines = self.text[path].count("\n")
            if lines > limits["file_lines"] and "// LONG BECAUSE" not in self.text[path].split("\n\n")[0]:
                self.complain(path, 1, f"{lines} lines, more than {limits['file_lines']}")
        for tag in self.functions():
            self.check_function(tag, limits)

    def check_function(self, tag, limits):
        path, first = tag["path"], tag["line"]
        if tag["kind"] == "function" and "end" in tag:
            length = tag["end"] - first + 1
            body = self.text[path].splitlines()[max(first - 4, 0):tag["end"]]
            if length > limits["function_lines"] and not any(l.strip().startswith("// LONG BECAUSE") for l in body):
                self.complain(path, first, f"{tag['name']} has {length} lines and no line // LONG BECAUSE")
        count = parameter_count(tag.get("signature", ""))
        given = tag["name"].startswith("LLVMFuzzer")  # libFuzzer says how it calls them
        if count > limits["parameters"] and not given and not path.startswith("tests/"):
            self.complain(path, first, f"{tag['name']} has {count} parameters, more than {limits['parameters']}")

    def functions(self):
        out = subprocess.run(["ctags", "-L", "-", "--output-format=json", "--fields=+neSK", "--language-force=C++",
                              "--kinds-C++=fp", "-f", "-"], input="\n".join(self.code), cwd=self.root,
                             capture_output=True, text=True, check=True).stdout
        return [json.loads(line) for line in out.splitlines() if line.startswith("{")]

    def check_machine_paths(self):
        for path in self.files:
            if path.endswith((".reel", ".png", ".glb", ".pc2")):
                continue
            for number, line in enumerate(self.read(path).splitlines(), 1):
                if MACHINE_PATH.search(line) and "MACHINE_PATH" not in line:
                    self.complain(path, number, "a path of one machine")

    def check_local_names(self):
        """Names local to a .cpp: unity builds compile the files of a room as one, where two of them must not meet."""
        owner = {}
        for path in self.code:
            if not path.endswith(".cpp") or path.startswith("fuzz/"):
                continue
            lines, inside = self.text[path].splitlines(), False
            for number, line in enumerate(lines, 1):
                inside = line == "namespace {" or (inside and not line.startswith("} // namespace"))
                name = local_name(line, lines[number] if number < len(lines) else "") if inside else None
                if name is None:
                    continue
                there = owner.setdefault((os.path.dirname(path), "slow" in path and "tests" in path, name), path)
                if there != path:
                    self.complain(path, number, f"{name} is a local name of {there} too")

    def check_tests(self):
        """Every source file of the library has a test file of its name, or another that includes its header."""
        included = {w for p in self.code if room_of(p) in ("tests",) for _, w in self.includes(p)}
        for path in self.code:
            if path.startswith("src/meshreel/") and path.endswith(".cpp"):
                header = path[len("src/"):-len(".cpp")] + ".h"
                room = os.path.dirname(header)
                if header not in included and not any(os.path.dirname(w) == room for w in included):
                    self.complain(path, 1, "no test includes its header or a header of its room")


def local_name(line, following):
    """What a line at file level names: a constant, a type, a function with its parameter types; or None."""
    if match := re.match(r"(?:constexpr|const) [\w:<>, ]*?(\w+)(?:\[\w*\])*(?: =|\{)", line):
        return match[1]
    if match := re.match(r"(?:struct|class|enum class) (\w+)[^;]*$", line):
        return match[1]
    if following == "{" and (match := re.match(r"[\w:<>,&* ]*?(?<!:)\b(\w+)\((.*)\)$", line)):
        return f"{match[1]}({re.sub(r'(?<=[&*> ])[a-z_]+(?=,|$)', '', match[2])})"
    return None


def parameter_count(signature):
    """Top-level commas of '(int a, std::map<int, int> b)', plus one."""
    inner = signature[signature.find("(") + 1:signature.rfind(")")].strip()
    if not inner or inner == "void":
        return 0
    depth, count = 0, 1
    for letter in inner:
        depth += letter in "<([{"
        depth -= letter in ">)]}"
        count += letter == "," and depth == 0
    return count


def circles(edges):
    """Groups of files of which each includes, by way of others, each (Tarjan)."""
    sys.setrecursionlimit(100000)
    index, low, stack, found = {}, {}, [], []

    def visit(v):
        index[v] = low[v] = len(index)
        stack.append(v)
        for w in edges.get(v, ()):
            if w not in index:
                visit(w)
                low[v] = min(low[v], low[w])
            elif w in stack:
                low[v] = min(low[v], index[w])
        if low[v] == index[v]:
            group = []
            while not group or group[-1] != v:
                group.append(stack.pop())
            if len(group) > 1:
                found.append(group)

    for v in edges:
        if v not in index:
            visit(v)
    return found


def main(argv):
    root = argv[0] if argv else os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
    house = House(os.path.normpath(root))
    house.check_first_lines()
    house.check_arrows()
    house.check_circles()
    house.check_sizes()
    house.check_machine_paths()
    house.check_local_names()
    house.check_tests()
    for complaint in sorted(set(house.complaints)):
        print(complaint)
    print(f"floors: {len(house.code)} files, {len(set(house.complaints))} complaints")
    return 1 if house.complaints else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
