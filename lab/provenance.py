"""What made a figure: commit, compiler, machine, programs, data."""
# SPDX-License-Identifier: MIT
import hashlib
import os
import subprocess

SOURCES = ("src", "cli", "lab", "CMakeLists.txt")  # what a figure depends on


def digest(*paths):
    whole = hashlib.sha256()
    for path in paths:
        with open(path, "rb") as file:
            while block := file.read(1 << 20):
                whole.update(block)
    return whole.hexdigest()


def commit(root):
    """The commit, and whether what a figure depends on differs from it."""
    git = lambda *words: subprocess.check_output(["git", "-C", root, *words], text=True, stderr=subprocess.DEVNULL).strip()
    try:
        changed = git("status", "--porcelain", "--untracked-files=no", "--", *SOURCES, ":!lab/results", ":!lab/ledger.csv")
        return git("rev-parse", "--short=12", "HEAD") + (" and changes" if changed else "")
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def cache_of(folder):
    """The settings of a CMake build folder."""
    known = {}
    with open(os.path.join(folder, "CMakeCache.txt"), encoding="utf-8") as file:
        for line in file:
            name, _, value = line.strip().partition("=")
            known[name.split(":")[0]] = value
    return known


def compiler(known):
    path = known.get("CMAKE_CXX_COMPILER", "c++")
    said = subprocess.run([path, "--version"], stdout=subprocess.PIPE, text=True).stdout.splitlines()[:1]
    return (said or [path])[0]


def build(folder):
    """Compiler and flags of a CMake build folder."""
    known = cache_of(folder)
    kind = known.get("CMAKE_BUILD_TYPE", "")
    flags = f"{known.get('CMAKE_CXX_FLAGS', '')} {known.get(f'CMAKE_CXX_FLAGS_{kind.upper()}', '')}".strip()
    return f"{compiler(known)}, {kind}, {flags}"


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return "unknown processor"


def encoder(folder):
    """What an encoder's rounding may depend on: compiler, C library, processor."""
    return f"{compiler(cache_of(folder))}; {os.confstr('CS_GNU_LIBC_VERSION')}; {processor()}"


def machine():
    """Processor, cores, memory, kernel."""
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    return f"{processor()}, {os.cpu_count()} cores, {memory:.0f} GB, Linux {os.uname().release}"
