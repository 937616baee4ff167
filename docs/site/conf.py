"""The manual as a web site: ./dev site. Pages are staged by stage.py, links between them are checked (-W)."""

project = "Espalier"
author = "the authors of Espalier"
extensions = ["myst_parser"]
root_doc = "index"
myst_heading_anchors = 4
# L-systems are highlighted as C, which they are not quite.
suppress_warnings = ["misc.highlighting_failure", "toc.circular"]
highlight_language = "none"

html_theme = "furo"
html_title = "Espalier"
html_copy_source = False
html_show_sourcelink = False
html_show_sphinx = False
html_show_copyright = False
html_permalinks_icon = "#"
html_static_path = ["_static"]
html_css_files = ["site.css"]
