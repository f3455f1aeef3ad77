"""What docs/python.md and the site show is run: the blocks of a page, one after
another, in one namespace."""
import pathlib
import re

import pytest

DOCS = pathlib.Path(__file__).parents[2] / "docs"
DOCUMENT = DOCS / "python.md"
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.M | re.S)
PAGES = [page for page in sorted((DOCS / "site" / "pages").rglob("*.md"))
         if BLOCK.search(page.read_text(encoding="utf-8"))]


@pytest.mark.parametrize("page", [DOCUMENT, *PAGES], ids=lambda page: page.stem)
def test_the_blocks_of_a_page_run(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = page.read_text(encoding="utf-8")
    names = {}
    for block in BLOCK.finditer(text):
        line = text[:block.start(1)].count("\n")
        source = "\n" * line + block[1]
        exec(compile(source, str(page), "exec"), names)


def test_the_chapter_and_the_site_have_blocks():
    assert len(BLOCK.findall(DOCUMENT.read_text(encoding="utf-8"))) > 5
    assert len(PAGES) >= 5


def test_the_readme_names_the_chapter():
    readme = DOCUMENT.parents[1] / "README.md"
    assert "docs/python.md" in readme.read_text(encoding="utf-8")
