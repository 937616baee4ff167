"""Recorded runs."""

import json
import pathlib

from . import _espalier


class Run:
    """A run as it lies in a folder."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        try:
            self.record = json.loads((self.folder / "run.json").read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise _espalier.Error(f"{self.folder}: no recorded run ({error})") from error

    @property
    def statistics(self):
        """statistics.csv as a DataFrame of pandas: a row for each step and plant."""
        import pandas  # takes half a second: only where it is asked for

        return pandas.read_csv(self.folder / "statistics.csv")

    def _repr_png_(self):
        from .looking import png

        return png(self)


def open(folder):
    """Opens the folder of a run; raises Error if there is none."""
    return Run(folder)
