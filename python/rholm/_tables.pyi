"""The types of what is made of the library's tables. scripts/python-stub writes this file."""

from typing import Any, Literal

Window = Literal[
    "ideal",
    "lanczos",
    "lanczos2",
    "gaussian",
    "heat",
    "exponential",
    "plateau",
]

class Described:
    @property
    def volume(self) -> float | Any:
        """Volume of the solid bounded by the surface (exact for a radius), in the unit of length to
        the power 3. None for a signed sum."""
    @property
    def area(self) -> float | Any:
        """Area of the surface (accurate to about 1e-12), in the unit of length to the power 2. None
        for a signed sum."""
    @property
    def sphericity(self) -> float | Any:
        """Area of the ball of equal volume divided by the area of the surface, at most 1 (Wadell
        1935). None for a signed sum."""
