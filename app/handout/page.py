"""The HTML of a page that stands alone."""

from __future__ import annotations

import base64
import hashlib
import html
from functools import cache
from string import Template
from urllib.parse import quote

from lineseg import __version__

from ..places import data_folder
from .bundle import script_of, style_of

SHEETS = (
    "base.css", "widgets/controls.css", "widgets/dialog.css", "widgets/tooltip.css", "widgets/decision.css",
    "widgets/track.css", "widgets/words.css", "widgets/symbols.css", "stage/stage.css", "stage/overlay.css",
    "bars/topbar.css", "keys.css", "tune/explanation.css", "tune/replay.css", "tune/panel.css", "tune/sliders.css",
    "learn/learn.css", "learn/stepper.css", "learn/listing.css", "learn/formulas.css", "learn/charts.css",
    "learn/lessons.css", "learn/answers.css", "learn/diagram.css", "learn/blocks.css", "learn/shown/shown.css",
    "learn/ladder.css", "learn/glossary.css", "handout/handout.css", "handout/sheet.css",
)  # fmt: skip
LIST_SHEETS = ("base.css", "learn/lessons.css", "handout/list.css")
# Tells our pages from other files.
GENERATOR = f'<meta name="generator" content="lineseg {__version__}">'
# What asks the server, and what takes its place.
INSTEAD = {"fetch.js": "handout/answers.js", "learn/picture.js": "handout/picture.js"}
DOCUMENT = Template("""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="$policy">
$generator
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>$title</title>
<link rel="icon" href="$icon">
<style>$style</style>
</head>
$body
</html>
""")
BODY = Template("""<body class="handout">
<header id="topbar" class="topbar"></header>
<main id="main" class="main" data-mode="learn">
<section id="stage" class="stage"><p id="opening" class="handout-opening">Opening…</p></section>
<section id="stepper" class="replay stepper"></section>
<aside id="learn" class="panel learn"></aside>
</main>
<noscript>This page needs JavaScript. Turn it on and reload it.</noscript>
$sheet
<script type="application/octet-stream" id="data">$data</script>
<script type="module">$script</script>
</body>""")


def page_of(title: str, data: str, sheet: str = "") -> str:
    """The page. title: any text; data: base64; sheet: HTML that is printed instead of what is on the screen."""
    script = _script()
    paper = f'<section class="sheet print-only">{sheet}</section>' if sheet else ""
    return document(title, BODY.substitute(data=data, script=script, sheet=paper), _style(), script)


def document(title: str, body: str, style: str, script: str = "") -> str:
    """A page that loads nothing. title: any text; body: HTML, with the script if there is one."""
    return DOCUMENT.substitute(
        policy=policy_of(style, script),
        generator=GENERATOR,
        title=html.escape(title),
        icon=icon(),
        style=style,
        body=body,
    )


def policy_of(style: str, script: str) -> str:
    """Nothing may be loaded, and nothing may run but this script."""
    scripts = f"script-src {_hash(script)}; " if script else ""
    return f"default-src 'none'; {scripts}style-src {_hash(style)}; img-src data:; base-uri 'none'; form-action 'none'"


def _hash(text: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


@cache
def _style() -> str:
    return style_of(data_folder("static"), list(SHEETS))


@cache
def _script() -> str:
    script = script_of(data_folder("static"), "handout/main.js", INSTEAD)
    # Inside of HTML, a script ends at the first of these.
    assert "</script" not in script.lower() and "<!--" not in script
    return script


@cache
def list_style() -> str:
    """The style of a list of lessons."""
    return style_of(data_folder("static"), list(LIST_SHEETS))


@cache
def icon() -> str:
    """The icon as the address of an image."""
    return "data:image/svg+xml," + quote((data_folder("static") / "icon.svg").read_text("utf-8"))
