#!/usr/bin/env python3
"""Writes the man page share/man/dsc.1 and the bash completion share/completion/dsc from what `dsc --help` says of every command.

    share/manual.py [--dsc build/dev/bin/dsc]                    writes them
    share/manual.py [--dsc build/dev/bin/dsc] --check FOLDER     writes them below FOLDER, exits 1 if those here differ
"""
import re
import subprocess
import sys
from dataclasses import dataclass, field

import generated

SECTION = re.compile(r"^(Positionals|Options|Subcommands):$")
ENTRY = re.compile(r"^  (\S.*?)(?:\s{2,}(\S.*))?$")


@dataclass
class Entry:
    """A positional, an option or a subcommand as its help shows it."""
    head: str       # "--progress TEXT:{auto,never,json}=auto"
    text: str = ""

    @property
    def names(self):
        """["-o", "--output"] of an option, ["run"] of a command, ["CONFIG"] of a positional."""
        return self.head.split()[0].split(",")

    @property
    def argument(self):
        """What follows the names, without the words that the parser adds: "TEXT", or nothing for a flag."""
        words = self.head.split()[1:]
        return re.split(r"[:=]", words[0])[0] if words and words[0] != "Excludes:" else ""

    @property
    def choices(self):
        found = re.search(r"\{([^}]*)\}", self.head)
        return found.group(1).split(",") if found else []

    @property
    def required(self):
        return "REQUIRED" in self.head.split()


@dataclass
class Command:
    words: list
    text: str
    usage: str
    footer: str
    sections: dict = field(default_factory=dict)
    below: list = field(default_factory=list)

    @property
    def name(self):
        return " ".join(["dsc", *self.words])


def ask(dsc, *words):
    return subprocess.run([dsc, *words], check=True, stdout=subprocess.PIPE, text=True).stdout


def read_command(dsc, words):
    """A command and all below it."""
    lines = ask(dsc, *words, "--help").splitlines()
    command = Command(list(words), lines[0], "", "", {"Positionals": [], "Options": [], "Subcommands": []})
    entries = None
    for line in lines[1:]:
        section = SECTION.match(line)
        if line.startswith("Usage: "):
            command.usage = line[len("Usage: "):]
        elif section:
            entries = command.sections[section.group(1)]
        elif line.startswith("    ") and entries:
            entries[-1].text = f"{entries[-1].text} {line.strip()}".strip()
        elif line.startswith("  ") and entries is not None:
            entries.append(Entry(*(part or "" for part in ENTRY.match(line).groups())))
        elif line.startswith("Exit codes: "):
            command.footer = line[len("Exit codes: "):]
        elif line.strip():
            raise SystemExit(f"manual.py does not understand a line of {command.name} --help: {line}")
    command.below = [read_command(dsc, [*words, entry.names[0]]) for entry in command.sections["Subcommands"]]
    return command


def leaves(command):
    if not command.below:
        yield command
    for one in command.below:
        yield from leaves(one)


# ---- man page -----------------------------------------------------------------------------------------------------------

ENVIRONMENT = [
    ("DSC_CORE_DUMP", "1: after a crash in a run and the report about it, the process ends by the signal, so that the system writes a core file."),
    ("DSC_PLUGIN_PATH", "Folders of plugins, parted by colons; dsc plugin path shows what is looked through."),
    ("DSC_SHARE", "Folder of the data that dsc brings, where it is not the installed one."),
]
FILES = [
    ("config.resolved.yaml", "The experiment with every default written out; running it reproduces the run."),
    ("status.json", "running, done, stopped or failed, and why."),
    ("summary.json, metrics.csv, events.jsonl", "Figures of the result, of every step, and the topology changes."),
    ("provenance.json", "Versions, plugins and inputs with their hashes, command, machine, times."),
    ("result/", "Surface and volume; there only when they are whole."),
]
EXAMPLES = [
    ("A surface and a volume from a point cloud:", "dsc reconstruct cloud.ply -o surface.obj -o volume.vtu"),
    ("An experiment with one value changed:", "dsc run experiment.yaml velocity.alpha=0.3 -o run"),
    ("The folders of a sweep, and the table of their results:", "dsc sweep expand sweep.yaml -o sweep\ndsc sweep collect sweep -o results.csv --groups groups.csv"),
]


def roff(text):
    """Text as it reads: backslashes, hyphens and leading dots are special."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\n".join(f"\\&{line}" if line.startswith((".", "'")) else line for line in text.split("\n"))


def man_entry(entry):
    head = ", ".join(f"\\fB{roff(name)}\\fR" for name in entry.names)
    if entry.argument:
        head += f" \\fI{roff(entry.argument)}\\fR"
    text = entry.text
    if any(choice not in text for choice in entry.choices):
        text += f"; one of {', '.join(entry.choices)}"
    return f".TP\n{head}\n{roff(text)}"


def man_command(command):
    lines = [f".SS \"{roff(command.name)}\"", roff(command.text) + ".", ".PP", f"\\fB{roff(command.usage)}\\fR"]
    for entry in command.sections["Positionals"]:
        name = f"\\fI{roff(entry.names[0])}\\fR"
        lines.append(f".TP\n{name}\n{roff(entry.text)}")
    lines += [man_entry(entry) for entry in command.sections["Options"] if "--help" not in entry.names]
    return "\n".join(lines)


def man_list(pairs):
    return "\n".join(f".TP\n\\fB{roff(name)}\\fR\n{roff(text)}" for name, text in pairs)


def man_page(root):
    codes = [re.match(r"(\d+) (.*)", part).groups() for part in root.footer.rstrip(".").split(", ")]
    parts = [
        ".\\\" Written by share/manual.py from what dsc says of itself.",
        ".TH DSC 1 \"\" dsc \"User commands\"",
        f".SH NAME\ndsc \\- {roff(root.text[0].lower() + root.text[1:].rstrip('.'))}",
        ".SH SYNOPSIS\n" + "\n.br\n".join(f"\\fB{roff(command.usage)}\\fR" for command in leaves(root)),
        ".SH DESCRIPTION\n" + roff(
            "dsc turns a point cloud without normals into a watertight surface and the conforming tetrahedral mesh inside and "
            "outside it, with a deformable simplicial complex. Experiments name their strategies, which are plugins, in YAML.\n"
            "Data go to stdout, log and progress to stderr. Values of an experiment are overridden by dotted path, "
            "velocity.alpha=0.3."),
        ".SH COMMANDS\n" + "\n".join(man_command(command) for command in leaves(root)),
        ".SH EXIT STATUS\n" + man_list(codes),
        ".SH ENVIRONMENT\n" + man_list(ENVIRONMENT),
        ".SH FILES\nA run folder, \\fB\\-o\\fR \\fIDIR\\fR or \\fIruns/NAME/HASH\\fR, holds\n" + man_list(FILES),
        ".SH EXAMPLES\n" + "\n".join(f"{roff(text)}\n.PP\n.nf\n.RS\n{roff(line)}\n.RE\n.fi\n.PP" for text, line in EXAMPLES),
    ]
    return "\n".join(parts) + "\n"


# ---- completion ---------------------------------------------------------------------------------------------------------

COMPLETION = """\
# bash completion for dsc, written by share/manual.py from what dsc says of itself.

_dsc() {{
    # What may come in each command, and after those options that take one of a few words.
    local -A words=(
{words}
    )
    local -A values=(
{values}
    )
    local command='' next word=${{COMP_WORDS[COMP_CWORD]}} previous='' i
    for ((i = 1; i < COMP_CWORD; i++)); do
        next="${{command:+$command }}${{COMP_WORDS[i]}}"
        if [[ -n ${{words[$next]+known}} ]]; then command=$next; fi
        previous=${{COMP_WORDS[i]}}
    done
    COMPREPLY=()
    local offered=''
    if [[ -n ${{values["$command $previous"]+known}} ]]; then
        offered=${{values["$command $previous"]}}
    elif [[ $word == -* || -z $command || " {groups} " == *" $command "* ]]; then
        offered=${{words[${{command:-dsc}}]}}
    fi
    # Without an offer the shell completes names of files.
    [[ -z $offered ]] || mapfile -t COMPREPLY < <(compgen -W "$offered" -- "$word")
}}
complete -o default -F _dsc dsc
"""


def all_commands(command):
    yield command
    for one in command.below:
        yield from all_commands(one)


def completion(root):
    words, values = [], []
    for command in all_commands(root):
        key = " ".join(command.words)
        offers = [entry.names[0] for entry in command.sections["Subcommands"]]
        for entry in command.sections["Options"]:
            offers += entry.names
            if entry.choices:
                values += [f"        ['{key} {name}']='{' '.join(entry.choices)}'" for name in entry.names]
        words.append(f"        ['{key or 'dsc'}']='{' '.join(offers)}'")
    groups = " ".join(" ".join(command.words) for command in all_commands(root) if command.words and command.below)
    return COMPLETION.format(words="\n".join(words), values="\n".join(values), groups=groups)


def manual(dsc):
    """{path below share/: text} of everything that is generated."""
    root = read_command(dsc, [])
    return {"man/dsc.1": man_page(root), "completion/dsc": completion(root)}


if __name__ == "__main__":
    sys.exit(generated.main("manual.py", __doc__, manual, ["man/*", "completion/*"]))
