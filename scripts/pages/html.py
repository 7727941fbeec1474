# SPDX-License-Identifier: BSD-3-Clause
"""A page of sections with plotly figures, which are dictionaries with `data` and `layout`."""

import html
import json

STYLE = """
body { font: 15px/1.4 sans-serif; color: #222; max-width: 1200px; margin: 1em auto; padding: 0 1em }
h1 { font-size: 1.5em } h2 { font-size: 1.15em; margin: 1.5em 0 .3em }
table { border-collapse: collapse } td, th { padding: .15em .9em .15em 0; text-align: left;
border-bottom: 1px solid #ddd } img { max-width: 100% } input[type=range] { width: 100% }
"""


def page(title, sections):
    """Returns the text of a page with the library in it. `sections`: pairs of a heading and its
    contents in HTML. Raises ImportError without plotly."""
    from plotly.offline import get_plotlyjs  # only here, since loading takes a second
    parts = [f"<h2>{html.escape(heading)}</h2>\n{contents}" for heading, contents in sections]
    return ("<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'>"
            f"<title>{html.escape(title)}</title><style>{STYLE}</style>\n"
            f"<script>{get_plotlyjs()}</script></head>\n"
            f"<body><h1>{html.escape(title)}</h1>\n" + "\n".join(parts) + "\n</body></html>\n")


def figure(name, contents, height=450):
    """Returns a figure; `name` is its element's id, `height` in pixels."""
    return (f"<div id='{name}' style='height:{height}px'></div>\n<script>"
            f"Plotly.newPlot('{name}', {as_json(contents['data'])}, {as_json(contents['layout'])},"
            " {responsive: true, displaylogo: false})</script>")


def table(rows):
    """Returns a table; cells are plain text."""
    lines = ["<tr>" + "".join(f"<td>{text(cell)}</td>" for cell in row) + "</tr>" for row in rows]
    return "<table>" + "\n".join(lines) + "</table>"


def text(value):
    return html.escape(str(value))


def as_json(value):
    """Returns JSON for a script element, which a closing tag inside a string would end."""
    return json.dumps(value, allow_nan=False).replace("</", "<\\/")
