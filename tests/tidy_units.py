#!/usr/bin/env python3
# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""tests/tidy_units.py BUILD OUT: joins sources of one folder and one target for clang-tidy.

clang-tidy spends most of its time on the headers of libraries, once for each unit of compilation.
Reads BUILD/compile_commands.json and writes OUT/compile_commands.json with larger units.
"""
import json
import pathlib
import re
import sys

UNIT_SIZE = 24
# Sources that do not compile beside others of their folder.
ALONE = re.compile(r"/options/|/mpi/|/map/|/examples/|/fuzz/|boundary_cut_|power_table_test")


def sources_of(file):
    """The sources that a unit of CMake includes, or the file itself."""
    if "/Unity/" not in file:
        return [file]
    return re.findall(r'#include "(.*\.cpp)"', pathlib.Path(file).read_text())


def main(build, out):
    out = pathlib.Path(out)
    out.mkdir(parents=True, exist_ok=True)
    units = {}
    for entry in json.loads((pathlib.Path(build) / "compile_commands.json").read_text()):
        if "_autogen/" in entry["file"]:
            continue
        # Without its output and its source, the command is that of all sources of the target.
        command = re.sub(r" -o \S+ -c \S+$", "", entry["command"])
        for source in sources_of(entry["file"]):
            folder = source if ALONE.search(source) else pathlib.Path(source).parent
            units.setdefault((command, folder), []).append(source)
    commands, seen = [], set()
    for (command, _), sources in units.items():
        sources = [source for source in sources if source not in seen]
        seen.update(sources)
        for first in range(0, len(sources), UNIT_SIZE):
            unit = out / f"unit_{len(commands)}.cpp"
            unit.write_text("".join(f'#include "{s}"\n' for s in sources[first:first + UNIT_SIZE]))
            commands.append({"directory": str(out), "file": str(unit),
                             "command": f"{command} -c {unit}"})
    (out / "compile_commands.json").write_text(json.dumps(commands, indent=1))


if __name__ == "__main__":
    main(*sys.argv[1:])
