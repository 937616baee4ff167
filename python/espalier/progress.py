"""A bar of progress on standard error, in terminals and notebooks alike: both write over a line that ends in \\r."""

import sys
import time

_WIDTH = 30
_SECONDS = 0.1  # between two bars


class Bar:
    """The bar of a growth of so many steps."""

    def __init__(self, steps):
        self._steps = max(steps, 1)
        self._began = time.monotonic()
        self._shown = float("-inf")

    def show(self, done, at_end):
        """Draws the bar after `done` steps, ten times a second and at the end."""
        now = time.monotonic()
        if not at_end and now - self._shown < _SECONDS:
            return
        self._shown = now
        full = min(_WIDTH, _WIDTH * done // self._steps)
        bar = "#" * full + "." * (_WIDTH - full)
        sys.stderr.write(f"\r[{bar}] step {done}/{self._steps}  {now - self._began:.1f} s" + ("\n" if at_end else ""))
        sys.stderr.flush()
