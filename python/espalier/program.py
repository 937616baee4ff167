"""The program espalier, which draws, exports and measures: the module itself loads no library for pictures."""

import json
import os
import pathlib
import re
import shutil
import signal
import subprocess

from . import _espalier

_DONE_ALL_THE_SAME = {"tree": (3, 4)}  # growth that ended early; its files are written
_PLACE = re.compile(r"^(?P<file>.+?):(?P<line>\d+):(?:(?P<column>\d+):)? ")


def program():
    """The path of the program: ESPALIER_PROGRAM, that of the build folder, that which was installed with the module, or that
    of PATH. Raises Error if none is."""
    package = pathlib.Path(__file__).parent  # below a build folder, or PREFIX/lib/python3.11/site-packages
    beside = [folder / "espalier" for folder in (package.parents[1], *(parent / "bin" for parent in package.parents[2:4]))]
    candidates = [os.environ.get("ESPALIER_PROGRAM"), *filter(pathlib.Path.is_file, beside), shutil.which("espalier")]
    for path in candidates:
        if path:
            return str(path)
    raise _espalier.Error("the program espalier is not on PATH; set ESPALIER_PROGRAM to its path")


def options(values):
    """Options of the command line from keywords: colour_by="age" is --colour-by age; True is a flag; a list, a tuple or
    a dict ({"R": 2} is R=2) repeats the option; None and False leave it out."""
    for name, value in values.items():
        option = "--" + name.replace("_", "-")
        if value is True:
            yield option
        elif isinstance(value, dict):
            for key, one in value.items():
                yield from (option, f"{key}={one}")
        elif isinstance(value, (list, tuple)):
            for one in value:
                yield from (option, str(one))
        elif value is not None and value is not False:
            yield from (option, str(value))


def call(command, *arguments, **values):
    """Runs a command and returns what it printed. Its mistakes are raised as Error, failed runs as RunError.

    Ctrl-C is handed on to the program, which ends after its step, and raised when it has.
    """
    line = [program(), command, *map(str, arguments), *options(values)]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True, "encoding": "utf-8"}
    try:
        child = subprocess.Popen(line, start_new_session=True, **pipes)
    except OSError as error:
        raise _espalier.Error(f"{line[0]} does not start: {error.strerror}") from error
    interrupted = False
    while True:
        try:
            printed, told = child.communicate()
            break
        except KeyboardInterrupt:
            interrupted = True
            child.send_signal(signal.SIGINT)
    if interrupted:
        raise KeyboardInterrupt
    if child.returncode not in (0, *_DONE_ALL_THE_SAME.get(command, ())):
        raise _error_of(child.returncode, told, printed)
    return printed


def call_for_json(command, *arguments, **values):
    """As call(), with what the command prints as JSON."""
    return json.loads(call(command, *arguments, json=True, **values))


def _error_of(code, told, printed):
    told = told.strip() or _message_in(printed) or f"espalier ended with exit code {code}"
    error = (_espalier.RunError if code == 2 else _espalier.Error)(told)
    place = next((match for match in map(_PLACE.match, told.splitlines()) if match), None)
    numbers = place.groupdict() if place else {}
    error.file = numbers.get("file")
    error.line = int(numbers["line"]) if numbers.get("line") else None
    error.column = int(numbers["column"]) if numbers.get("column") else None
    return error


def _message_in(printed):
    try:
        return json.loads(printed).get("message", "")
    except ValueError:
        return ""
