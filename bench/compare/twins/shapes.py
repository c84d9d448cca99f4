"""Triangles: positions, corners of triangles, texture coordinates."""
import math

import numpy as np


def quad(corners):
    """A quad, seen from the side from which its corners run against the clock."""
    return (np.array(corners, np.float32), np.array([[0, 1, 2], [0, 2, 3]], np.uint32),
            np.array([[0, 1], [1, 1], [1, 0], [0, 0]], np.float32))


def ground(size=6.0):
    return quad([[-size, 0, size], [size, 0, size], [size, 0, -size], [-size, 0, -size]])


def card(height=1.2, size=1.2):
    return quad([[-size, height, size], [size, height, size], [size, height, -size],
                 [-size, height, -size]])


def lamp():
    return quad([[-1, 3.5, -1], [1, 3.5, -1], [1, 3.5, 1], [-1, 3.5, 1]])


def ball(radius=0.9, centre=(0.0, 1.0, 0.0), cuts=2):
    """An icosahedron, each face cut into four `cuts` times: flat facets."""
    golden = (1 + math.sqrt(5)) / 2
    points = [np.array(p, float) for p in
              [(-1, golden, 0), (1, golden, 0), (-1, -golden, 0), (1, -golden, 0),
               (0, -1, golden), (0, 1, golden), (0, -1, -golden), (0, 1, -golden),
               (golden, 0, -1), (golden, 0, 1), (-golden, 0, -1), (-golden, 0, 1)]]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
             (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
             (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    for _ in range(cuts):
        middles, finer = {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(points)
                points.append((points[a] + points[b]) / 2)
            return middles[key]

        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = finer
    placed = np.array([radius * p / np.linalg.norm(p) + centre for p in points])
    return (placed.astype(np.float32), np.array(faces, np.uint32),
            np.zeros((len(points), 2), np.float32))
