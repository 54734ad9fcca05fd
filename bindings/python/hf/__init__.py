"""hf: dynamic harmonic fields. Sites come and go on a factored surface; handles pose it; motion plays on another.

    import numpy as np, hf
    surface = hf.Surface(positions, triangles)
    solver = hf.Solver(surface)
    solver.add_sites([0, 41], [0.0, 1.0])
    field = solver.solve()

The C headers (include/hf) are the reference, and classes are made from them. Objects close themselves, in any order;
failures are exceptions with the library's own message, HfError and its subclasses. What Python's users expect beyond the
headers is here: faces as hosts store them, matrices row by row.
"""

from typing import Any, Dict, Optional

import numpy as _np

from . import _api, _errors, _library
from . import _raw as constants
from ._api import *  # noqa: F401,F403
from ._errors import *  # noqa: F401,F403
from ._library import ArrayLike, version

__version__ = constants.HEADER_VERSION
NO_INDEX = constants.HF_NO_INDEX
__all__ = sorted({*_api.__all__, *_errors.__all__, "NO_INDEX", "constants", "version"})


def _faces(faces: Any) -> Dict[str, Any]:
    """(m, k) corners, (offsets, corners) or (starts, sizes, corners) as the fields of hf_faces_desc."""
    if not isinstance(faces, tuple):
        around = _library.numbers(faces, "faces")
        wide = around.ndim == 2 and around.shape[1] > 2
        _library.require(wide, "faces must have the shape (m, 3) or wider, not {}", around.shape)
        faces = None, _np.full(len(around), around.shape[1], _np.uint32), around
    _library.require(len(faces) in (2, 3), "faces must be (offsets, corners) or (starts, sizes, corners)")
    return {"starts": faces[0], "sizes": faces[1] if len(faces) == 3 else None, "corners": faces[-1]}


class Surface(_api.Surface):
    __doc__ = f"""{_api.Surface.__doc__}
    faces: (m, k) corners; (offsets, corners), m + 1 offsets; or (starts, sizes, corners) as Blender's loops, with None
        for starts where faces follow one another
    link_pieces: True joins the pieces of a character by links. tags: (n,) with it: pieces of different tags stay apart
    """

    def __init__(self, positions: ArrayLike, triangles: Optional[ArrayLike] = None, *, faces: Any = None,
                 link_pieces: bool = False, tags: Optional[ArrayLike] = None, **options: Any) -> None:
        _library.require(positions is not None, "positions is None", error=_errors.NullPointerError)
        _library.require(link_pieces or tags is None, "tags need link_pieces=True")
        if link_pieces:
            options["links"] = {"mode": _api.LinkMode.PIECES, "tags": tags}
        super().__init__(positions, triangles, **options, faces=None if faces is None else _faces(faces))


class Pose(_api.Pose):
    __doc__ = _api.Pose.__doc__

    def set_matrices(self, handles: ArrayLike, matrices: ArrayLike) -> None:
        """Rigid 4 x 4 matrices rest -> posed, (k, 4, 4) in the usual row-by-row reading."""
        rows = _library.converted(matrices, "matrices", "f8")
        _library.require(rows.size % 16 == 0, "matrices must have the shape (k, 4, 4), not {}", rows.shape)
        super().set_matrices(handles, rows.reshape(-1, 4, 4).transpose(0, 2, 1))
