#!/usr/bin/env python3
"""Builds the fuzz targets and runs each for some seconds of the processor: tools/fuzz.py [SECONDS] [TARGET...], --help.

At most 512 MB each, 120 s an input (of the clock: a busy machine stretches them). What a run finds stays in build-fuzz/corpus,
where the next one goes on. Ends with a table; --keep adds it to fuzz/ledger.csv and renews the page that shows it."""
# SPDX-License-Identifier: MIT
import argparse
import concurrent.futures
import csv
import dataclasses
import datetime
import glob
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
OUT = os.path.join(ROOT, "build-fuzz")
LEDGER = os.path.join(ROOT, "fuzz/ledger.csv")
PAGE = os.path.join(ROOT, "docs/threat-model.md")
BEGIN, END = "<!-- made by tools/fuzz.py -->\n", "<!-- end -->\n"
WHOLE_FILES = {"reel", "reel_threads", "player", "wasm_boundary"}  # these start from .reel files
MOST_STRETCHED = 10  # seconds of the clock for one of the processor
INTERRUPTED = 72     # libFuzzer's exit code, with its figures told
TICKS = os.sysconf("SC_CLK_TCK")

stopped = threading.Event()


@dataclasses.dataclass
class Row:
    """What is known of a target: sums over its runs, and what the newest one covered."""
    target: str
    cpu_seconds: float = 0.0
    runs: int = 0
    edges: int = 0
    of: int = 0  # edges in the program
    corpus: int = 0
    findings: int = 0
    last: str = ""

    def plus(self, run):
        seen = run if run.edges > 0 else self  # a run cut off before it had read its corpus tells nothing of coverage
        return Row(self.target, round(self.cpu_seconds + run.cpu_seconds, 1), self.runs + run.runs, seen.edges, seen.of, seen.corpus,
                   self.findings + run.findings, run.last)


def read_ledger(path=LEDGER):
    if not os.path.exists(path):
        return {}
    with open(path, newline="", encoding="utf-8") as file:
        kinds = {field.name: field.type for field in dataclasses.fields(Row)}
        return {row["target"]: Row(**{name: kinds[name](cell) for name, cell in row.items()}) for row in csv.DictReader(file)}


def write_ledger(rows, path=LEDGER):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, [field.name for field in dataclasses.fields(Row)], lineterminator="\n")
        writer.writeheader()
        writer.writerows(dataclasses.asdict(rows[target]) for target in sorted(rows))


def markdown(rows):
    lines = ["| target | CPU s | runs | edges | of all | findings |", "|---|---|---|---|---|---|"]
    for row in sorted(rows.values(), key=lambda row: row.target):
        lines.append(f"| `{row.target}` | {row.cpu_seconds:,.0f} | {row.runs:,} | {row.edges:,} | {share(row)} | {row.findings} |".replace(",", " "))
    lines.append(f"| all {len(rows)} | {sum(row.cpu_seconds for row in rows.values()):,.0f} | {sum(row.runs for row in rows.values()):,} | | | "
                 f"{sum(row.findings for row in rows.values())} |".replace(",", " "))
    return "\n".join(lines) + "\n"


def renew_page(rows):
    with open(PAGE, encoding="utf-8") as file:
        before, rest = file.read().split(BEGIN)
    after = rest.split(END, 1)[1]
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write(before + BEGIN + markdown(rows) + END + after)


def share(row):
    return f"{100 * row.edges / max(row.of, 1):.1f} %"


def told(row):
    return f"{row.target:26} {row.runs:10} {row.cpu_seconds:8.1f} {row.edges:8} {share(row):>8} {row.corpus:7} {row.findings:9}"


def row_of(target, log, cpu_seconds):
    """What a run's log says."""
    last = lambda pattern: int((re.findall(pattern, log) or [0])[-1])
    edges = last(r" cov: (\d+)") if "\tINITED " in log else 0  # of a corpus that was read to its end
    return Row(target, round(cpu_seconds, 1), last(r"number_of_executed_units: (\d+)"), edges, last(r"\((\d+) inline 8-bit counters\)"),
               last(r" corp: (\d+)"), last=datetime.date.today().isoformat())


def all_targets():
    return sorted(os.path.basename(path).removesuffix("_fuzz.cpp") for path in glob.glob(os.path.join(ROOT, "fuzz/*_fuzz.cpp")))


def starts_of(target):
    """The corpus, which libFuzzer adds to, and what it only reads: the target's own seeds, files of its kind."""
    corpus, seeds = os.path.join(OUT, "corpus/fuzz_" + target), os.path.join(ROOT, "fuzz/seeds", target)
    os.makedirs(corpus, exist_ok=True)
    files = os.path.join(OUT, "files", "reel" if target in WHOLE_FILES else target.removeprefix("io_"))
    return [corpus, *(folder for folder in (seeds, files) if os.path.isdir(folder))]


def copy_files():
    """Small golden files and earlier findings, a folder for each kind."""
    shutil.rmtree(os.path.join(OUT, "files"), ignore_errors=True)
    for path in glob.glob(os.path.join(ROOT, "tests/golden/*.reel")) + glob.glob(os.path.join(ROOT, "tests/malformed/[0-9]*")):
        folder = os.path.join(OUT, "files", path.rsplit(".", 1)[1])
        os.makedirs(folder, exist_ok=True)
        if os.path.getsize(path) < 8 << 10:
            shutil.copy(path, folder)


def used_seconds(pid):
    """Of the processor, by a process that runs: by its own threads, in and below the system."""
    with open(f"/proc/{pid}/stat", encoding="utf-8") as file:
        words = file.read().rsplit(")", 1)[1].split()
    return (int(words[11]) + int(words[12])) / TICKS


def wait(process, seconds):
    """Until it ends or has used up its seconds; it is then asked to tell its figures. @return what it used."""
    asked = False
    while True:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        if pid != 0:
            process.returncode = os.waitstatus_to_exitcode(status)
            return usage.ru_utime + usage.ru_stime
        if not asked and (stopped.is_set() or used_seconds(process.pid) >= seconds):
            process.send_signal(signal.SIGUSR1)
            asked = True
        time.sleep(0.2)


def run(target, arguments):
    """@return the row of this run, and whether nothing was found."""
    if stopped.is_set():
        return Row(target), True
    crash, path = os.path.join(OUT, f"crash-{target}-"), os.path.join(OUT, f"fuzz_{target}.log")
    before = set(glob.glob(crash + "*"))
    environment = {**os.environ, "ASAN_OPTIONS": "quarantine_size_mb=16:allocator_may_return_null=0"}  # as much as fits into 512 MB
    command = [os.path.join(OUT, "fuzz/fuzz_" + target), f"-max_total_time={MOST_STRETCHED * arguments.seconds}", f"-seed={arguments.seed}", "-timeout=120",
               "-report_slow_units=120", "-rss_limit_mb=512", "-max_len=8192", "-print_final_stats=1", "-artifact_prefix=" + crash, *starts_of(target)]
    with open(path, "wb") as log:
        process = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT, env=environment)
        cpu_seconds = wait(process, arguments.seconds)
    with open(path, encoding="utf-8", errors="replace") as log:
        said = log.read()
    row = row_of(target, said, cpu_seconds)
    row.findings = len(set(glob.glob(crash + "*")) - before)
    good = process.returncode in ([0, INTERRUPTED] if stopped.is_set() else [0])
    print(f"fuzz: {target}: " + (f"{row.runs} runs, nothing found" if good else f"FAILED, see {path}\n" + "\n".join(said.splitlines()[-40:])), flush=True)
    return row, good


def build(targets, jobs):
    subprocess.run(["cmake", "--preset", "fuzz"], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", OUT, "-j", str(jobs), "--target", "golden_files", *("fuzz_" + target for target in targets)], cwd=ROOT, check=True)


def keep(row):
    """Adds a run to the ledger at once: a session that is cut off has counted what it did."""
    before = read_ledger()
    rows = {target: before.get(target, Row(target)) for target in all_targets()}
    rows[row.target] = rows[row.target].plus(row)
    write_ledger(rows)
    renew_page(rows)


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("seconds", nargs="?", type=int, default=10, help="of the processor, for each target")
    parser.add_argument("targets", nargs="*", help="default: all")
    parser.add_argument("--seed", type=int, default=0, help="the same seed, the same inputs; 0: another one each time")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="how many at once")
    parser.add_argument("--without", action="append", default=[], metavar="TARGET")
    parser.add_argument("--built", action="store_true", help="builds nothing")
    parser.add_argument("--keep", action="store_true", help="adds what is run to fuzz/ledger.csv")
    arguments = parser.parse_args(words)
    unknown = set(arguments.targets + arguments.without) - set(all_targets())
    if unknown:
        parser.error("there is no target " + ", ".join(sorted(unknown)))
    arguments.targets = [target for target in arguments.targets or all_targets() if target not in arguments.without]
    return arguments


def main():
    arguments = parse(sys.argv[1:])
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: stopped.set())
    if not arguments.built:
        build(arguments.targets, arguments.jobs)
    copy_files()
    rows, clean = [], True
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for ended in concurrent.futures.as_completed([pool.submit(run, target, arguments) for target in arguments.targets]):
            row, good = ended.result()
            rows.append(row)
            clean = clean and good
            if arguments.keep and row.runs > 0:
                keep(row)
    table = [f"{'target':26} {'runs':>10} {'CPU s':>8} {'edges':>8} {'of all':>8} {'corpus':>7} {'findings':>9}",
             *(told(row) for row in sorted(rows, key=lambda row: row.target))]
    print("\n".join(table))
    return 0 if clean else 1


if __name__ == "__main__":
    sys.exit(main())
