"""What a Collada file says about the colours of its parts, where a picture needs no more than that."""

from xml.etree.ElementTree import Element

import numpy as np

from gelenk.operations.display.glb import Colour

_SHADED = ("phong", "blinn", "lambert")
_BLACK = (0.0, 0.0, 0.0)
_LOOK = "profile_COMMON/technique"


class NotPlain(ValueError):
    """A part has a texture, lets light through, or is lit in no usual way."""


def colour_of(effect: Element | None) -> Colour | None:
    """Return the colours of an effect, None if there is none.

    Raises NotPlain if colours alone would show something else, and other exceptions where the file contradicts itself.
    """
    if effect is None:
        return None
    found = [effect.find(f"{_LOOK}/{kind}") for kind in _SHADED]
    shaded = next((look for look in found if look is not None), None)
    if shaded is None or shaded.find(".//texture") is not None:
        raise NotPlain
    transparency = float(shaded.findtext("transparency/float") or "1")
    transparent = shaded.find("transparent")
    if transparent is not None or transparency != 1.0:
        given = "A_ONE" if transparent is None else transparent.get("opaque", "A_ONE")
        numbers = _numbers(shaded, "transparent") or (1.0, 1.0, 1.0, 1.0)
        if given != "A_ONE" or numbers[-1] * transparency != 1.0:
            raise NotPlain
    return Colour(_linear(shaded, "diffuse"), _linear(shaded, "emission"))


def _linear(shaded: Element, name: str) -> tuple[float, ...]:
    """Return a colour as intensities of light (the inverse of the sRGB curve)."""
    given = np.clip(_numbers(shaded, name)[:3] or _BLACK, 0.0, 1.0)
    return tuple(np.where(given <= 0.04045, given / 12.92, ((given + 0.055) / 1.055) ** 2.4).round(6).tolist())


def _numbers(shaded: Element, name: str) -> tuple[float, ...]:
    return tuple(map(float, (shaded.findtext(f"{name}/color") or "").split()))
