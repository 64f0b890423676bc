#!/usr/bin/env python3
"""Makes the pictures of pages from their code: gallery.py [PAGE...] runs the blocks of docs/gallery.md and README.md
(or of the pages given) in a scratch folder, and puts each PNG that they write and the page shows into docs/pictures, in
few colours. gallery.py --report draws the head of a comparison's report by a browser (chromium):
docs/pictures/report.png."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import octafield
from octafield.domain.generators import generate
from octafield.view.scene import fewer_colours
from PIL import Image, ImageChops, ImageOps, ImageStat
from pyvista import examples

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "python"))
from docs_blocks import run_page  # noqa: E402

WIDEST = 760  # pixels; shown at about half of that
COLOURS = 128


def shown(page: Path) -> list[Path]:
    """The pictures of the folder "gallery" that a page shows."""
    names = re.findall(r"pictures/gallery/(\w+\.png)", page.read_text(encoding="utf-8"))
    return [ROOT / "docs" / "pictures" / "gallery" / name for name in dict.fromkeys(names)]


def alike(one: Path, other: Path) -> bool:
    """Whether two pictures show the same thing, as far as a thumbnail tells: drivers draw edges differently."""
    thumbs = [small(picture).convert("L").resize((24, 24)) for picture in (one, other)]
    return ImageStat.Stat(ImageChops.difference(*thumbs)).mean[0] < 8


def small(picture: Path) -> Image.Image:
    """Without the white around it, no wider than a page needs, in few colours."""
    image = Image.open(picture).convert("RGB")
    white = Image.new("RGB", image.size, image.getpixel((0, 0)))
    if box := ImageChops.difference(image, white).getbbox():
        image = ImageOps.expand(image.crop(box), 12, white.getpixel((0, 0)))
    image.thumbnail((WIDEST, WIDEST), Image.Resampling.LANCZOS)
    return fewer_colours(image, COLOURS)


def make(page: Path) -> None:
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        octafield.write_surface(generate("box"), "part.stl")  # what the commands of README.md read
        run_page(page)
        for picture in shown(page):
            picture.parent.mkdir(exist_ok=True)
            small(Path(picture.name)).save(picture, optimize=True)
            print(picture.relative_to(ROOT), picture.stat().st_size)
        os.chdir(ROOT)


def draw_report() -> None:
    with tempfile.TemporaryDirectory() as folder:
        out, drawn = Path(folder) / "report", Path(folder) / "report.png"
        compare = ["-m", "octafield", "compare", str(examples.nutfile), "-o", str(out), "--edge-length", "4", "-q"]
        subprocess.run([sys.executable, *compare], check=True)
        window = ["--window-size=1000,1000", "--hide-scrollbars", f"--screenshot={drawn}", f"file://{out}/report.html"]
        browser = next(filter(None, map(shutil.which, ("chromium", "google-chrome"))), None)
        if browser is None:
            raise SystemExit("the report is drawn by a browser; install the Debian package chromium")
        subprocess.run([browser, "--headless", "--no-sandbox", "--disable-gpu", *window], check=True)
        small(drawn).save(ROOT / "docs" / "pictures" / "report.png", optimize=True)


if __name__ == "__main__":
    if sys.argv[1:] == ["--report"]:
        draw_report()
    else:
        for name in sys.argv[1:] or ["docs/gallery.md", "README.md"]:
            make((ROOT / name).resolve())
