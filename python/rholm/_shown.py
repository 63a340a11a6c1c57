"""Methods that show an object: pictures, reports, and the display in notebooks."""

from __future__ import annotations

import importlib
import os
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._pictures import Picture


def _pictures() -> Any:
    """Returns the module that draws. It knows all classes of objects, and so stands above their
    modules. They do not import it: it is loaded when it draws for the first time.
    """
    return importlib.import_module(f"{__package__}._pictures")


class Shown:
    """Base of objects that have a picture. Notebooks display them."""

    __slots__ = ()

    def render(self, **options: Any) -> Picture:
        """Returns a picture of the object.

        Parameters
        ----------
        **options
            Arguments of `rholm.render`.

        Examples
        --------
        >>> import rholm
        >>> rholm.icosphere(2).render(size=(64, 48)).shape
        (48, 64, 3)
        """
        picture: Picture = _pictures().render(self, **options)
        return picture

    def _repr_png_(self) -> bytes | None:
        png: bytes | None = _pictures().notebook_png(self)
        return png


class Reported(Shown):
    """Base of models, which have a report as well."""

    __slots__ = ()

    def report_html(self, path: str | os.PathLike[str] | None = None, **options: Any) -> str:
        """Returns a report on one HTML page that needs no other file.

        Parameters
        ----------
        path : path, optional
            File to write as well.
        **options
            Arguments of `rholm.report_html`.

        Examples
        --------
        >>> import rholm
        >>> page = rholm.expand(rholm.icosphere(2), 2).report_html(picture_size=64)
        >>> page[:15].lower()
        '<!doctype html>'
        """
        page: str = _pictures().report_html(self, path, **options)
        return page

    def _repr_html_(self) -> str:
        text: str = _pictures().notebook_html(self)
        return text
