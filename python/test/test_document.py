"""What docs/python.md shows is run, block by block, in one namespace."""
import pathlib
import re

DOCUMENT = pathlib.Path(__file__).parents[2] / "docs" / "python.md"


def test_the_blocks_of_the_chapter_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = DOCUMENT.read_text(encoding="utf-8")
    blocks = list(re.finditer(r"^```python\n(.*?)^```$", text, re.M | re.S))
    assert len(blocks) > 5
    names = {}
    for block in blocks:
        line = text[:block.start(1)].count("\n")
        source = "\n" * line + block[1]
        exec(compile(source, str(DOCUMENT), "exec"), names)


def test_the_readme_names_the_chapter():
    readme = DOCUMENT.parents[1] / "README.md"
    assert "docs/python.md" in readme.read_text(encoding="utf-8")
