"""A picture with its caption and legend, as reports show it."""

import io
from dataclasses import dataclass, field

from . import scene

PAGE_SIZE = (1100, 825)


@dataclass
class Picture:
    """A rendered picture with a caption stating facts from the data and a legend of (colour, meaning)."""

    title: str
    caption: str
    png: bytes
    legend: list[tuple[str, str]] = field(default_factory=list)

    @property
    def small(self) -> bytes:
        """PNG for a page: no wider than a column needs, in few colours."""
        from PIL import Image

        with Image.open(io.BytesIO(self.png)) as shot:
            image = shot.convert("RGB")
        image.thumbnail(PAGE_SIZE, Image.Resampling.LANCZOS)
        data = io.BytesIO()
        scene.fewer_colours(image, 128).save(data, "PNG", optimize=True)
        return data.getvalue()
