"""What `lavalight SUBCOMMAND --help` says, taken apart: for the manual, man pages and completions."""
import re
import subprocess
from dataclasses import dataclass


COLUMN = 30  # where meanings begin in --help


def help_of(program, command):
    return subprocess.run([program, *command.split(), "--help"], check=True, capture_output=True, text=True).stdout


def entries_of(text):
    """(section, name, meaning) of each option, positional and subcommand."""
    entries, section = [], None
    for line in text.splitlines():
        if re.fullmatch(r"\S[^:]*:", line):
            section = line[:-1]
        elif section and re.match(r"  \S", line):
            name, gap, meaning = line[2:].partition("  ")
            if not gap and line[COLUMN - 1:COLUMN] == " " and " " in line[COLUMN:]:  # a name that ends where meanings begin
                name, meaning = line[2:COLUMN], line[COLUMN:]
            entries.append([section, name.strip(), meaning.strip()])
        elif section and line.startswith("    "):
            entries[-1][2] = f"{entries[-1][2]} {line.strip()}".strip()
    return [tuple(entry) for entry in entries if not entry[1].startswith("-h,--help")]


def subcommands_of(program, command=""):
    """The subcommands that run something: `bench rays`, not `bench`."""
    below = [name for section, name, _ in entries_of(help_of(program, command)) if section == "Subcommands"]
    found = [leaf for name in below for leaf in subcommands_of(program, f"{command} {name}".strip())]
    return found or [command]


@dataclass(frozen=True)
class Option:
    names: tuple  # ("-o", "--output")
    value: str  # what follows it, as --help has it; empty for a flag
    meaning: str

    @property
    def choices(self):
        """The words among its values: `sobol` and `independent` of `sobol|independent=sobol`, none of `FILE`."""
        kinds = self.value.split("=")[0].split("|")
        return tuple(kind for kind in kinds if re.fullmatch(r"[a-z][a-z0-9-]*", kind))

    @property
    def takes_file(self):
        return bool(re.search(r"FILE|DIR|\.(exr|png|json|html|csv)", self.value))


@dataclass(frozen=True)
class Command:
    name: str  # "render", "bench rays"; empty for the program itself
    summary: str
    usage: str
    entries: tuple  # of entries_of(), without the options
    options: tuple


def option_of(name, meaning):
    names, _, rest = name.partition(" ")
    # `REQUIRED` and `Excludes: --csv` are about the option, not its value.
    value = re.sub(r"\s*(REQUIRED|Excludes:.*|Needs:.*)$", "", rest)
    return Option(tuple(names.split(",")), value, meaning)


def command_of(program, name):
    text = help_of(program, name)
    lines = text.splitlines()
    usage = next(line.partition("Usage: ")[2] for line in lines if line.startswith("Usage: "))
    entries = entries_of(text)
    rest = tuple(entry for entry in entries if not entry[1].startswith("-"))
    options = tuple(option_of(*entry[1:]) for entry in entries if entry[1].startswith("-"))
    return Command(name, lines[0], usage, rest, options + (Option(("-h", "--help"), "", "Print help and exit"),))


def commands_of(program):
    """The program itself, then every subcommand, those with subcommands of their own included."""
    found = []

    def visit(name):
        command = command_of(program, name)
        found.append(command)
        for section, below, _ in command.entries:
            if section == "Subcommands":
                visit(f"{name} {below}".strip())

    visit("")
    return found
