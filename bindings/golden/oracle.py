"""Expected figures of the golden scenes: fields by a dense solve, rays by brute force, digests of arrays. Needs numpy."""

import numpy as np

import golden


def laplacian(mesh):
    points, n = np.array(mesh["positions"]).reshape(-1, 3), len(mesh["positions"]) // 3
    matrix = np.zeros((n, n))
    for triangle in np.array(mesh["triangles"]).reshape(-1, 3):
        for k in range(3):
            i, j, o = triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3]
            a, b = points[i] - points[o], points[j] - points[o]
            weight = np.dot(a, b) / np.linalg.norm(np.cross(a, b)) / 2
            matrix[i, i] += weight
            matrix[j, j] += weight
            matrix[i, j] -= weight
            matrix[j, i] -= weight
    return matrix


def edited(matrix, links, stiffness):
    """A Laplacian with links (vertex, three corners, three shares, weight), and edges of the stiffness of their ends."""
    edges = -matrix
    for vertex, *rest in links:
        for corner, share in zip(rest[:3], rest[3:6]):
            edges[[vertex, corner], [corner, vertex]] += share * rest[6] / np.sqrt(3)  # two equilateral triangles
    edges *= 2 * np.outer(stiffness, stiffness) / np.add.outer(stiffness, stiffness)
    np.fill_diagonal(edges, 0)
    return np.diag(edges.sum(1)) - edges


def field(mesh, rows, values, stiffness=None, power=1, change=lambda matrix: matrix):
    """rows: per site a vertex or {vertex: weight}; power 2: bi-harmonic on the graph, K = L^2."""
    matrix = np.linalg.matrix_power(change(laplacian(mesh)), power)
    n, k = len(matrix), len(rows)
    system, right = np.zeros((n + k, n + k)), np.zeros(n + k)
    system[:n, :n], right[n:] = matrix, values
    for c, row in enumerate(rows):
        for vertex, weight in (row if isinstance(row, dict) else {row: 1.0}).items():
            system[n + c, vertex] = weight
            system[vertex, n + c] = -weight
        if stiffness is not None and stiffness[c]:
            system[n + c, n + c] = 1 / (stiffness[c] * np.mean(np.diag(matrix)))
    return np.linalg.solve(system, right)[:n]


def graph_field(vertex_count, edges, weights, sites, values, masses=None):
    """The field of a graph with hard sites; masses: bi-harmonic, K = L M^-1 L with the mean mass of a component as 1."""
    matrix = np.zeros((vertex_count, vertex_count))
    for (a, b), weight in zip(edges, weights):
        matrix[[a, b], [a, b]] += weight
        matrix[[a, b], [b, a]] -= weight
    linked = np.linalg.matrix_power(np.abs(matrix) + np.eye(vertex_count), vertex_count) > 0
    if masses is not None:
        mean = np.array([np.mean(np.array(masses)[row]) for row in linked])
        matrix = matrix @ np.diag(mean / np.array(masses)) @ matrix
    found = np.zeros(vertex_count)
    found[sites] = values
    free = [v for v in range(vertex_count) if v not in sites and linked[v, sites].any()]
    found[free] = np.linalg.solve(matrix[np.ix_(free, free)], -matrix[np.ix_(free, sites)] @ values)
    return found


def expect(array, tolerance=1e-9):
    flat = np.asarray(array, float).ravel()
    places = sorted({0, flat.size // 3, flat.size // 2, flat.size - 1}) if flat.size else []
    return {**golden.digest(flat), "at": places, "values": [float(flat[p]) for p in places], "tolerance": tolerance}


def expect_all(array, tolerance=1e-9):
    """Every number of a short array."""
    return {"count": len(array), "at": list(range(len(array))), "values": [float(x) for x in array],
        "tolerance": tolerance}


def agree(tolerance=1e-7):
    """Figures that the C++ run fills in (tests/bindings/golden.cpp): the languages must agree on them."""
    return {"agree": True, "tolerance": tolerance}


def cast_ray(points, triangles, origin, direction):
    """found, triangle, vertex, weights, position, distance of the first triangle on a ray (Moeller and Trumbore 1997)."""
    best, origin, direction = None, np.array(origin), np.array(direction)
    for t, (a, b, c) in enumerate(triangles):
        edges = np.array([points[b] - points[a], points[c] - points[a], -direction]).T
        if abs(np.linalg.det(edges)) < 1e-14:
            continue
        v, w, distance = np.linalg.solve(edges, origin - points[a])
        if min(v, w, 1 - v - w, distance) >= 0 and (best is None or distance < best[-1]):
            place = origin + distance * direction
            corner = min((a, b, c), key=lambda i: np.linalg.norm(points[i] - place))
            best = [1, t, int(corner), 1 - v - w, v, w, *place, distance]
    return np.array(best or [0], float)


def straight_path(points, triangles, start, end):
    """The straight line between two places of a flat mesh: its ends, and where it crosses edges."""
    at = lambda place: points[place[0]] if len(place) == 1 else np.array(place[3:]) @ points[place[:3]]
    a, b = at(start)[:2], at(end)[:2]
    params = [0.0, 1.0] if start != end else [0.0]
    for p, q in {tuple(sorted((int(t[k]), int(t[k - 1])))) for t in triangles for k in range(3)}:
        sides = np.array([b - a, points[p][:2] - points[q][:2]]).T
        if abs(np.linalg.det(sides)) < 1e-12:
            continue
        along, across = np.linalg.solve(sides, points[p][:2] - a)
        if 1e-9 < along < 1 - 1e-9 and -1e-12 < across < 1 + 1e-12:
            params.append(along)
    return np.array([[*(a + s * (b - a)), 0.0] for s in sorted(params)])


def inside_polygon(points, corners):
    """The points of a flat mesh that a polygon encloses."""
    inside = np.zeros(len(points), bool)
    for (ax, ay), (bx, by) in zip(corners[:, :2], np.roll(corners[:, :2], -1, 0)):
        spans = (points[:, 1] < ay) != (points[:, 1] < by)
        inside ^= spans & (points[:, 0] < ax + (points[:, 1] - ay) * (bx - ax) / (by - ay))
    return inside


def rotation(q):
    x, y, z, w = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def expect_rows(points, rows):
    picked = list(range(0, len(rows), 5))
    return {"at": [3 * rows[k] + c for k in picked for c in range(3)], "values": [float(points[k][c]) for k in picked
        for c in range(3)], "tolerance": 1e-9}
