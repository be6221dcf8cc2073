"""Stresses in a body that ends along x: those of the mirrored half-space, and of its free ends.

The pressure is even about the planes of the ends: beside one plane the grid is doubled, between two
it repeats after twice their distance. That is all between frictionless walls. What free ends add
is found wave by wave along y (`end_stress`, `end_waves`).
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.mechanics.halfspace import end_stress, long_strip, strip
from viscontact.mechanics.halfspace.end_stress import Places, RowLoads
from viscontact.mechanics.halfspace.end_waves import WaveMeans, near_waves
from viscontact.mechanics.halfspace.ended_load import EndedLoad, Face
from viscontact.mechanics.halfspace.ended_response import EndedLayers, EndedResponse
from viscontact.mechanics.halfspace.layered_stress import LayeredStress
from viscontact.mechanics.halfspace.stress import Stress, stress_on_plane, stress_on_section
from viscontact.mechanics.halfspace.stress_lines import Progress, part_of
from viscontact.mechanics.halfspace.stress_response import HalfSpaceStress, StressResponse
from viscontact.units.formatting import format_quantity

#: Most depth between two ends, in distances from a free one to the plane of symmetry or the wall.
DEEPEST = 50.0

#: Components that change their sign with the direction of x.
ODD_ALONG = np.array([1, 1, 1, 1, -1, -1])[:, None, None, None, None]


def ended_stress_on_section(
    load: EndedLoad,
    depths: Floats,
    *,
    x: float | None = None,
    y: float | None = None,
    progress: Progress | None = None,
) -> Stress:
    """Stress on a vertical plane, (6, fields, nz, nx or ny); NaN beyond the ends.

    ValueError if the plane of given x lies beyond an end.
    """
    fields, grid, own = load.mirrored
    body = response_of(load.response)
    part = part_of(progress, 0, 2) if load.faces else progress
    if x is not None:
        check_inside(load.response, x)
        found = stress_on_section(fields, grid, depths, body, x=x, progress=part).components
        added = added_stress(load, np.array([x]), depths, load.grid.y, part_of(progress, 1, 2))
        return Stress(found + added[:, :, :, 0].swapaxes(2, 3))
    y = load.grid.centre[1] if y is None else y
    inside = stress_on_section(fields, grid, depths, body, y=y, progress=part).components[..., own]
    along = load.grid.x[load.rows]
    added = added_stress(load, along, depths, np.array([y]), part_of(progress, 1, 2))
    found = np.full((*inside.shape[:-1], load.grid.shape[0]), np.nan)
    found[..., load.rows] = inside + added[:, :, 0].swapaxes(2, 3)
    return Stress(found)


def ended_stress_on_plane(load: EndedLoad, depth: float) -> Stress:
    """Stress on a plane parallel to the surface, at the cells; NaN beyond the ends."""
    fields, grid, own = load.mirrored
    inside = stress_on_plane(fields, grid, depth, response_of(load.response)).components
    added = added_stress(load, load.grid.x[load.rows], np.array([depth]), load.grid.y)
    found = np.full((*inside.shape[:2], *load.grid.shape), np.nan)
    found[:, :, load.rows] = inside[:, :, own] + added[..., 0].swapaxes(2, 3)
    return Stress(found)


def check_inside(response: EndedResponse, x: float) -> None:
    """Refuse a plane beyond the ends."""
    before, after = response.planes
    if (before is not None and x < before) or (after is not None and x > after):
        raise ValueError(f"x: there is no body at {x!r} m, beyond its end; give a place within it")


def response_of(response: EndedResponse) -> StressResponse:
    """Stresses without ends; ValueError for layers with a free end."""
    if not isinstance(response, EndedLayers):
        return HalfSpaceStress(response.poisson_ratio)
    if any(response.free):
        raise ValueError(
            "stresses: these layers end at a face free of stress, near which their stresses are "
            "not known; they are between walls (ends: held), and in a body of one material"
        )
    return LayeredStress(response.stack)


def added_stress(
    load: EndedLoad,
    x: Floats,
    depths: Floats,
    y: Floats,
    progress: Progress | None = None,
) -> Floats:
    """Stress that free ends add to the mirrored half-space; (6, fields, y, x, depths) [Pa]."""
    count, targets = len(load.fields), len(y)
    found = np.zeros((6, count, targets, len(x), len(depths)))
    if not load.faces or not load.rows.stop > load.rows.start:
        return found
    means = WaveMeans.of(load, y)
    _check_depths(depths, load.half_length)
    nearest = min(float(face.distances(x).min()) for face in load.faces)
    for index, wave in enumerate(means.waves.tolist()):
        if wave * nearest <= end_stress.FAR:
            columns = [_amplitudes(face, means.at(index)) for face in load.faces]
            found += _by_wave(load, wave, columns, x, depths).reshape(found.shape)
        if progress is not None:
            progress(index + 1, len(means.waves))
    return found


def _amplitudes(face: Face, means: Floats) -> Floats:
    """Amplitudes of cos ky and sin ky about each y of each field; (rows, 2 fields y)."""
    both = (np.moveaxis(face.fields @ part.T, 1, 0) for part in means)
    return np.concatenate([each.reshape(len(each), -1) for each in both], axis=1)


def _check_depths(depths: Floats, half: float) -> None:
    """Refuse depths below a body between two ends at which its longest waves are not known."""
    deepest = float(depths.max(initial=0.0))
    if deepest > DEEPEST * half:
        raise ValueError(
            f"depths: stresses between two ends are known to {format_quantity(DEEPEST * half, 'm')}"
            f" here, {DEEPEST:g} half lengths, got {format_quantity(deepest, 'm')}; give smaller "
            "depths"
        )


def _by_wave(
    load: EndedLoad, wave: float, columns: list[Floats], x: Floats, depths: Floats
) -> Floats:
    """Stress of a wave by loads beside each face; (6, columns, x, depths)."""
    ratio, half, faces = load.response.poisson_ratio, load.half_length, load.faces
    row = load.grid.cell_size[0]
    loads = [RowLoads(face.borders, each, row) for face, each in zip(faces, columns, strict=True)]
    total = np.zeros((6, columns[0].shape[1] // 2, len(x), len(depths)))
    if wave * half >= strip.HIGHEST_WAVE:
        for face, own in zip(faces, loads, strict=True):
            places = Places(face.distances(x), depths)
            total += face_turned(face, end_stress.beside_face(ratio, wave, own, places))
        return total
    for face, nearer, signs in _halves(faces, x, half):
        places = Places(face.distances(x[nearer]), depths)
        if not nearer.any():
            continue
        for odd, sign in signs:
            part = _part(loads, odd=odd)
            for near, weight in near_waves(wave, long_strip.longest_wave(odd=odd) / half):
                stress = end_stress.between_faces(ratio, near, half, part, places, odd=odd)
                total[:, :, nearer] += weight * sign * face_turned(face, stress)
    return total


def _halves(
    faces: list[Face], x: Floats, half: float
) -> list[tuple[Face, Bools, list[tuple[bool, int]]]]:
    """Faces, the places that are nearer to them, and signs there of even and odd loads."""
    if len(faces) == 1:
        return [(faces[0], np.ones(len(x), dtype=bool), [(False, 1)])]
    first = faces[0].distances(x) <= half
    return [
        (faces[0], first, [(False, 1), (True, 1)]),
        (faces[1], ~first, [(False, 1), (True, -1)]),
    ]


def _part(loads: list[RowLoads], *, odd: bool) -> RowLoads:
    """Even or odd part of loads about the middle between two faces; that of one is even."""
    if len(loads) == 1:
        return loads[0]
    one, other = loads
    # Rows of the grid within the body need not be alike on both sides.
    borders = np.union1d(one.borders, other.borders)
    both = [_on_rows(each, borders) for each in loads]
    return RowLoads(borders, (both[0] + (-1 if odd else 1) * both[1]) / 2, one.row)


def _on_rows(load: RowLoads, borders: Floats) -> Floats:
    """Amplitudes on other rows, whose borders include those of the load."""
    middles = (borders[1:] + borders[:-1]) / 2
    row = np.searchsorted(load.borders, middles) - 1
    inside = (row >= 0) & (row < len(load.amplitudes))
    return np.where(inside[:, None], load.amplitudes[np.where(inside, row, 0)], 0.0)


def face_turned(face: Face, stress: Floats) -> Floats:
    """Stress with x from the face into the body, along x."""
    return stress if face.side > 0 else stress * ODD_ALONG[..., 0]
