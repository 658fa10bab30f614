"""Small GTS surfaces, sound and broken."""


def octahedron(radius=1.0):
    vertices = [(radius, 0, 0), (-radius, 0, 0), (0, radius, 0), (0, -radius, 0), (0, 0, radius), (0, 0, -radius)]
    faces = []
    for x in (0, 1):
        for y in (2, 3):
            for z in (4, 5):
                right_handed = (x == 0) ^ (y == 3) ^ (z == 5)
                faces.append((x, y, z) if right_handed else (y, x, z))
    return vertices, faces


def gts(vertices, faces):
    """The text of a GTS file: counts, vertices, edges (vertex pairs), faces (edge triples), all counted from 1."""
    edges, lines = {}, []
    for face in faces:
        numbers = []
        for a, b in zip(face, face[1:] + face[:1]):
            numbers.append(edges.setdefault(frozenset((a, b)), len(edges) + 1))
        lines.append("{} {} {}".format(*numbers))
    head = ["{} {} {} GtsSurface GtsFace GtsEdge GtsVertex".format(len(vertices), len(edges), len(faces))]
    points = ["{} {} {}".format(*v) for v in vertices]
    pairs = ["{} {}".format(*(sorted(v + 1 for v in edge))) for edge in edges]
    return "\n".join(head + points + pairs + lines) + "\n"


def sound():
    return gts(*octahedron())


def index_out_of_range():
    lines = sound().splitlines()
    lines[-1] = "1 2 99"
    return "\n".join(lines) + "\n"


def degenerate_face():
    lines = sound().splitlines()
    lines[-1] = "1 1 2"
    return "\n".join(lines) + "\n"


def face_without_area():
    vertices, faces = octahedron()
    vertices[4] = (0.5, 0.5, 0)  # on the edge between two others
    return gts(vertices, faces)


def hole():
    vertices, faces = octahedron()
    return gts(vertices, faces[:-1])


def flipped_face():
    vertices, faces = octahedron()
    a, b, c = faces[3]
    faces[3] = (b, a, c)
    return gts(vertices, faces)


def inside_out():
    vertices, faces = octahedron()
    return gts(vertices, [(b, a, c) for a, b, c in faces])


def non_manifold_edge():
    vertices, faces = octahedron()
    a, b, _ = faces[0]
    return gts(vertices + [(2, 2, 2)], faces + [(a, b, len(vertices))])


def truncated():
    return "\n".join(sound().splitlines()[:-4]) + "\n"


def not_a_number():
    lines = sound().splitlines()
    lines[2] = "0 zero 0"
    return "\n".join(lines) + "\n"


def two_pieces():
    vertices, faces = octahedron(0.3)
    moved = [(x + 1, y, z) for x, y, z in vertices]
    n = len(vertices)
    return gts(vertices + moved, faces + [(a + n, b + n, c + n) for a, b, c in faces])


def crossing_itself():
    """A face is drawn out into a spike that goes through the body and leaves it on the other side."""
    vertices, faces = octahedron()
    a, b, c = faces[0]
    tip = len(vertices)
    vertices = vertices + [(-0.9, -0.9, -0.8)]
    return gts(vertices, faces[1:] + [(a, b, tip), (b, c, tip), (c, a, tip)])
