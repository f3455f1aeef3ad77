#!/usr/bin/env python3
"""Builds the site: gathers its pages, makes their pictures, calls mkdocs.

  build.py PROGRAM MAKE_MODEL OUT [--python PYTHON] [--browser chromium]

PROGRAM is `halfspace`, MAKE_MODEL makes the models that the pages name, PYTHON
is an interpreter that has the package `halfspace`, matplotlib and numpy. OUT is
emptied; OUT/html is the site. Every block of the pages is run, the pictures that
they show are what the blocks have made, every link within the site is looked
up, and a browser searches in pages that are opened as files. Takes mkdocs,
mkdocs-material, doxygen, chromium and PIL.

Exit status: 0 all is well, 1 a block failed, a picture or what a link names is
missing or a search finds nothing, 2 bad usage.
"""
import argparse
import ast
import html.parser
import os
import pathlib
import re
import shutil
import subprocess
import sys
import urllib.parse

SITE = pathlib.Path(__file__).resolve().parent
ROOT = SITE.parent.parent
sys.path.insert(0, str(ROOT / "examples" / "test"))
import documents  # noqa: E402
import pictures  # noqa: E402

PICTURE = re.compile(r"!\[[^]]*\]\(([^)]+)\)")
NEEDED = {"mkdocs": "mkdocs and mkdocs-material", "doxygen": "doxygen"}


class Failed(Exception):
    """What is wrong with the site, in a sentence."""


def gather(pages):
    """The pages of the site, and beside them those of docs/ and spec/."""
    shutil.copytree(SITE / "pages", pages)
    for folder in ("docs", "spec"):
        (pages / folder).mkdir()
        for path in sorted((ROOT / folder).glob("*.md")):
            shutil.copy(path, pages / folder)
    shutil.copy(ROOT / "web" / "README.md", pages / "docs" / "web.md")
    (pages / "docs" / "figures").mkdir()
    for folder in ("decisions", "papers"):
        shutil.copytree(ROOT / "docs" / folder, pages / "docs" / folder)


def write_gallery(program, pages):
    """The figures of docs/figures, made anew, on a page."""
    figures = pages / "docs" / "figures"
    subprocess.run([sys.executable, ROOT / "docs/figures/make_figures.py",
                    program, figures], check=True)
    lines = ["# Gallery", "",
             "Made by `docs/figures/make_figures.py`; every figure is a map of "
             "exact regions, or a drawing of exact intervals."]
    for path in sorted(figures.glob("*.svg")):
        name = path.stem.capitalize()
        lines += ["", f"## {name}", "", f"![{name}](docs/figures/{path.name})"]
    (pages / "gallery.md").write_text("\n".join(lines) + "\n",
                                      encoding="utf-8")


def write_program(program, pages):
    """What `halfspace help` says of each command."""
    def said(*words):
        return subprocess.run([program, "help", *words], check=True, text=True,
                              stdout=subprocess.PIPE).stdout
    commands = re.findall(r"^  ([a-z]+)  ", said(), re.M)
    if len(commands) < 10:
        raise Failed(f"`halfspace help` names {len(commands)} commands only")
    text = ["# The program", "", "What `halfspace help` says, command by command.",
            "", "```text", said().rstrip(), "```"]
    for command in commands:
        text += ["", f"## {command}", "", "```text", said(command).rstrip(),
                 "```"]
    (pages / "program.md").write_text("\n".join(text) + "\n", encoding="utf-8")


def python_entries(path):
    """(heading, signature, documentation) of what a module shows."""
    tree = ast.parse(path.read_text(encoding="utf-8"))

    def signature(node):
        return f"{node.name}({ast.unparse(node.args)})"
    for node in tree.body:
        if getattr(node, "name", "_").startswith("_"):
            continue
        if isinstance(node, ast.FunctionDef):
            yield 3, signature(node), ast.get_docstring(node)
        elif isinstance(node, ast.ClassDef):
            yield 3, node.name, ast.get_docstring(node)
            for part in node.body:
                if isinstance(part, ast.FunctionDef) and part.name[0] != "_":
                    yield 4, signature(part), ast.get_docstring(part)


def write_python(pages):
    text = ["# Python", "",
            "Taken from the sources; `help(halfspace)` says the same."]
    for path in sorted((ROOT / "python" / "halfspace").glob("*.py")):
        entries = [entry for entry in python_entries(path) if entry[2]]
        if not entries:
            continue
        name = path.stem
        module = "halfspace" if name[0] == "_" else f"halfspace.{name}"
        text += ["", f"## {module} ({path.name})"]
        for level, signature, said in entries:
            text += ["", f"{'#' * level} {signature.split('(')[0]}", "",
                     "```python", signature, "```", "", "```text", said, "```"]
    (pages / "python.md").write_text("\n".join(text) + "\n", encoding="utf-8")


def write_javascript(pages):
    text = ["# JavaScript", "", "The types of the package, as they stand in it."]
    for name in ("halfspace", "manifold"):
        source = (ROOT / "web" / "package" / "src" / f"{name}.d.ts").read_text(
            encoding="utf-8")
        text += ["", f"## {name}.d.ts", "", "```typescript", source.rstrip(),
                 "```"]
    (pages / "javascript.md").write_text("\n".join(text) + "\n",
                                         encoding="utf-8")


def write_cpp(pages, out):
    """Doxygen's pages of the face, and one that lists its headers."""
    include = ROOT / "face" / "include" / "halfspace"
    settings = {
        "PROJECT_NAME": "Halfspace", "INPUT": include, "RECURSIVE": "YES",
        "OUTPUT_DIRECTORY": out, "HTML_OUTPUT": "cpp", "GENERATE_LATEX": "NO",
        "JAVADOC_AUTOBRIEF": "YES", "EXTRACT_ALL": "YES", "QUIET": "YES",
        "WARNINGS": "NO", "MARKDOWN_SUPPORT": "YES", "SORT_MEMBER_DOCS": "NO",
        "STRIP_FROM_PATH": include.parent, "GENERATE_TREEVIEW": "NO"}
    subprocess.run(["doxygen", "-"], check=True, text=True, input="".join(
        f"{key} = {value}\n" for key, value in settings.items()),
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    text = ["# C++", "",
            "One header, `<halfspace/halfspace.hpp>`, includes these. "
            "[Classes and functions](../cpp/annotated.html) are listed by "
            "Doxygen.", "", "| header | what it has |", "|---|---|"]
    for path in sorted(include.glob("*.hpp")):
        first = re.search(r"^/// (.*?)(?:\n///\s*\n|\n[^/])",
                          path.read_text(encoding="utf-8"), re.M | re.S)
        said = re.sub(r"\s*\n///\s*", " ", first[1]) if first else ""
        said = said.replace("|", "\\|").replace("<", "&lt;")
        text.append(f"| `halfspace/{path.name}` | {said.strip()} |")
    (pages / "cpp.md").write_text("\n".join(text) + "\n", encoding="utf-8")


def run_blocks(page, folder, environment, python):
    """Runs the commands and the Python of a page, from top to bottom."""
    script = []
    found = list(documents.blocks(page))
    for words, _, text in found:
        if words[:1] == ["text"] and len(words) == 2 and words[1] != "output":
            (folder / words[1]).write_text(text, encoding="utf-8")
    for words, first, text in found:
        if words == ["sh"]:
            if not documents.shell(text, folder, environment,
                                   f"{page}:{first}"):
                raise Failed(f"{page}:{first}: a command fails")
        elif words == ["python"]:
            script.append(text)
    if script:
        done = subprocess.run([python, "-c", "\n".join(script)], cwd=folder,
                              env=environment, text=True,
                              stderr=subprocess.PIPE)
        if done.returncode != 0:
            raise Failed(f"{page}: its Python fails:\n{done.stderr}")


def make_pictures(pages, program, make_model, work, python):
    """Runs the pages, and puts beside them the pictures that they show.

    What has been made takes the place of the pictures that the sources have;
    only the charts of experiments (docs/papers) are shown as they are there.
    """
    tools = os.pathsep.join(str(pathlib.Path(tool).resolve().parent)
                            for tool in (program, make_model))
    environment = dict(os.environ, EXAMPLES=str(ROOT / "examples"),
                       MPLBACKEND="Agg")
    environment["PATH"] = tools + os.pathsep + environment["PATH"]
    work.mkdir()
    if not documents.shell(documents.MODELS, work, environment, "the models"):
        raise Failed("the models cannot be made")
    run = {pages / path.relative_to(SITE / "pages")
           for path in (SITE / "pages").rglob("*.md")}
    guide = pages / "docs" / "guide.md"
    run_blocks(guide, work, environment, python)
    pictures.make(work, environment)
    text = guide.read_text(encoding="utf-8")
    for name in PICTURE.findall(text):
        vectors = pathlib.Path(name).with_suffix(".svg").name
        if (work / vectors).exists() and not (work / name).exists():
            text = text.replace(f"({name})", f"({vectors})")
    guide.write_text(text, encoding="utf-8")
    for page in sorted(run):
        run_blocks(page, work, environment, python)
    for page in sorted(pages.rglob("*.md")):
        for name in PICTURE.findall(page.read_text(encoding="utf-8")):
            made = work / name
            if made.exists() and "/" not in name:
                shutil.copy(made, page.parent / name)
            if not (page.parent / name).exists():
                raise Failed(f"{page.relative_to(pages)}: shows {name}, which "
                             "no block makes")


def plain_fences(pages):
    """Words after a fence that are for the tests, as MkDocs takes them."""
    for page in pages.rglob("*.md"):
        text = page.read_text(encoding="utf-8")
        text = re.sub(r"^(```\w+) (build|output)$", r"\1", text, flags=re.M)
        text = re.sub(r"^(```\w+) (\S+)$", r'\1 title="\2"', text, flags=re.M)
        page.write_text(text, encoding="utf-8")


def write_search_script(site):
    """The search's index as a script, which a page from a file can load."""
    index = (site / "search" / "search_index.json").read_text(encoding="utf-8")
    (site / "search" / "search_index.js").write_text(
        f"giveSearchIndex({index});\n", encoding="utf-8")


def check_search(site, browser):
    """The search finds its page when the site is opened as a file."""
    for words, page in (("matplotlib figure", "howto/matplotlib.html"),
                        ("drill print", "howto/print.html"),
                        ("four views", "howto/four-views.html"),
                        ("oracle", "howto/oracle.html")):
        address = (site / "index.html").as_uri() + "?q=" + \
            urllib.parse.quote(words)
        shown = subprocess.run(
            [browser, "--headless", "--no-sandbox", "--disable-gpu",
             "--virtual-time-budget=20000", "--dump-dom", address],
            check=True, text=True, stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL).stdout
        found = re.findall(r'<a href="([^"]*)" class="md-search-result__link',
                           shown)
        if not any(page in link for link in found[:3]):
            raise Failed(f"a search for {words!r} finds {found[:3]}, and not "
                         f"{page}")


class Links(html.parser.HTMLParser):
    """What a page leads to, and the places in it."""

    def __init__(self, text):
        super().__init__()
        self.named, self.places = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for key, value in attributes:
            if key in ("href", "src") and value:
                self.named.append(value)
            elif key in ("id", "name") and value:
                self.places.add(value)


def check_links(site):
    """Every link within the site names a file, and a place in it."""
    known, wrong, count = {}, [], 0

    def links_of(path):
        if path not in known:
            known[path] = Links(path.read_text(encoding="utf-8"))
        return known[path]
    pages = [path for path in sorted(site.rglob("*.html"))
             if (site / "cpp") not in path.parents and path.name != "404.html"]
    for page in pages:
        for named in links_of(page).named:
            link = urllib.parse.urlsplit(named)
            if link.scheme or link.netloc:
                continue
            count += 1
            path = urllib.parse.unquote(link.path)
            target = (page.parent / path).resolve() if path else page
            if target.is_dir():
                target = target / "index.html"
            if not target.exists():
                wrong.append(f"{page.relative_to(site)}: no {named}")
            elif (link.fragment and target.suffix == ".html"
                  and not link.fragment.startswith("__")
                  and urllib.parse.unquote(link.fragment)
                  not in links_of(target).places):
                wrong.append(f"{page.relative_to(site)}: no place {named}")
    if wrong:
        raise Failed("\n".join(wrong))
    return len(pages), count


def build(options):
    for tool, package in (*NEEDED.items(), (options.browser, "chromium")):
        if not shutil.which(tool):
            raise Failed(f"this takes {tool}; install {package}")
    if subprocess.run([options.python, "-c", "import halfspace, matplotlib"],
                      stderr=subprocess.DEVNULL).returncode != 0:
        raise Failed(f"{options.python} has no halfspace or no matplotlib; "
                     "see docs/python.md, or name another by --python")
    out = pathlib.Path(options.out).resolve()
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    pages = out / "pages"
    gather(pages)
    (pages / "reference").mkdir()
    write_gallery(options.program, pages)
    write_program(options.program, pages / "reference")
    write_python(pages / "reference")
    write_javascript(pages / "reference")
    write_cpp(pages / "reference", pages)
    make_pictures(pages, options.program, options.make_model, out / "work",
                  options.python)
    plain_fences(pages)
    settings = out / "mkdocs.yml"
    shutil.copy(SITE / "mkdocs.yml", settings)
    shutil.copytree(SITE / "theme", out / "theme")
    subprocess.run(["mkdocs", "build", "--quiet", "--config-file", settings],
                   check=True)
    write_search_script(out / "html")
    count, links = check_links(out / "html")
    check_search(out / "html", options.browser)
    print(f"{out / 'html' / 'index.html'}: {count} pages, {links} links within "
          "the site are right; the search works from a file")


def main():
    parser = argparse.ArgumentParser(description="Builds the site.")
    parser.add_argument("program")
    parser.add_argument("make_model")
    parser.add_argument("out")
    parser.add_argument("--python", default=sys.executable)
    parser.add_argument("--browser", default="chromium")
    try:
        build(parser.parse_args())
    except (Failed, subprocess.CalledProcessError) as failed:
        print(f"build.py: {failed}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
