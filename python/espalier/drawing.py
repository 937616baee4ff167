"""Pictures, pages and files of a run's folder, and how notebooks show what has one."""

import pathlib
import tempfile

from .program import call, call_for_json


def temporary_folder():
    """A folder that goes when its block ends."""
    return tempfile.TemporaryDirectory(prefix="espalier-")


def picture_file(folder, output, **options):
    """Draws a run as a picture or a film; returns the path."""
    call("render", folder, output=output, quiet=True, **options)
    return pathlib.Path(output)


def page_file(folder, output, **options):
    """Writes a run as one HTML page; returns the path."""
    call_for_json("share", folder, output=output, **options)
    return pathlib.Path(output)


def exported_file(folder, output, **options):
    """Writes frames of a run as a file of another program; returns the path."""
    call("export", folder, output=output, quiet=True, **options)
    return pathlib.Path(output)


def png_bytes(folder, **options):
    """The bytes of a picture of a run."""
    with temporary_folder() as scratch:
        return picture_file(folder, pathlib.Path(scratch) / "picture.png", **{"size": "480x360", **options}).read_bytes()


def page_element(folder, height=420, **options):
    """The page of a run as an element of a notebook's cell."""
    with temporary_folder() as scratch:
        page = page_file(folder, pathlib.Path(scratch) / "page.html", **{"frames": 60, **options})
        text = page.read_text(encoding="utf-8")
    style = f"width: 100%; height: {height}px; border: 0"
    quoted = text.replace("&", "&amp;").replace('"', "&quot;")
    return f'<iframe sandbox="allow-scripts" style="{style}" srcdoc="{quoted}"></iframe>'


class Drawable:
    """What notebooks show as a picture and as a page: a class that says where its run lies."""

    _picture_options = {}

    def _run_folder(self):
        """A context whose value is the folder of a run."""
        raise NotImplementedError

    def _repr_png_(self):
        with self._run_folder() as folder:
            return png_bytes(folder, **self._picture_options)

    def _repr_html_(self):
        with self._run_folder() as folder:
            return page_element(folder, **self._picture_options)
