#!/usr/bin/env python3
"""Writes the arm's visual meshes as Wavefront OBJ files into the folder `meshes` beside this script.

Each part is given in the frame of the MuJoCo body that carries it (metres, z up) and is built from two shapes:
a lathe (a filleted profile turned around an axis) and a loft (a row of closed outlines joined by a skin).
A file may hold several closed objects; the world's loader merges them. Run: python3 make_meshes.py
"""
import math
import os

TURN = 48  # points around a lathe or an outline
FILLET_STEPS = 4


# --- shapes: each returns (points, triangles) -----------------------------------------------------------------------

def loft(outlines):
    """Joins closed outlines of equal length; the first and the last one are closed by a fan."""
    count = len(outlines[0])
    points = [p for outline in outlines for p in outline]
    faces = []
    for ring in range(len(outlines) - 1):
        for i in range(count):
            a, b = ring * count + i, ring * count + (i + 1) % count
            faces += [(a, b, b + count), (a, b + count, a + count)]
    for ring, flip in ((0, True), (len(outlines) - 1, False)):
        outline = outlines[ring]
        points.append(tuple(sum(p[k] for p in outline) / count for k in range(3)))
        centre = len(points) - 1
        for i in range(count):
            a, b = ring * count + i, ring * count + (i + 1) % count
            faces.append((centre, b, a) if flip else (centre, a, b))
    return points, faces


def fillet(profile, radius):
    """Rounds the inner corners of an open polyline of (r, z)."""
    result = [profile[0]]
    for before, corner, after in zip(profile, profile[1:], profile[2:]):
        to_before = (before[0] - corner[0], before[1] - corner[1])
        to_after = (after[0] - corner[0], after[1] - corner[1])
        length_before, length_after = math.hypot(*to_before), math.hypot(*to_after)
        reach = min(radius, 0.49 * length_before, 0.49 * length_after)
        start = [corner[k] + to_before[k] / length_before * reach for k in range(2)]
        end = [corner[k] + to_after[k] / length_after * reach for k in range(2)]
        for step in range(FILLET_STEPS + 1):
            t = step / FILLET_STEPS
            result.append(tuple((1 - t) ** 2 * start[k] + 2 * t * (1 - t) * corner[k] + t ** 2 * end[k]
                                for k in range(2)))
    result.append(profile[-1])
    return result


def lathe(profile, radius=0.004, turn=TURN):
    """Turns a polyline of (r, z), listed with rising z, around the z axis."""
    rounded = [(max(r, 1e-4), z) for r, z in fillet(profile, radius)]
    return loft([[(r * math.cos(2 * math.pi * i / turn), r * math.sin(2 * math.pi * i / turn), z)
                  for i in range(turn)] for r, z in rounded])


def drum(radius, low, high, edge=0.004, turn=TURN):
    """A filleted cylinder along z."""
    return lathe([(0, low), (radius, low), (radius, high), (0, high)], edge, turn)


def capsule_outline(radius_a, radius_b, length):
    """Two circles, around (0, 0) and (length, 0), and their outer tangents: counter-clockwise points."""
    tilt = math.asin((radius_a - radius_b) / length) if length > abs(radius_a - radius_b) else 0.0
    half = TURN // 2
    points = []
    for i in range(half):
        angle = -math.pi / 2 + tilt + (math.pi - 2 * tilt) * i / (half - 1)
        points.append((length + radius_b * math.cos(angle), radius_b * math.sin(angle)))
    for i in range(half):
        angle = math.pi / 2 - tilt + (math.pi + 2 * tilt) * i / (half - 1)
        points.append((radius_a * math.cos(angle), radius_a * math.sin(angle)))
    return points


def plate(radius_a, radius_b, length, low, high, edge=0.004):
    """A capsule-shaped plate in the xy plane from z = low to high, with filleted edges."""
    layers = []
    for step in range(FILLET_STEPS + 1):
        angle = math.pi / 2 * step / FILLET_STEPS
        layers.append((edge * (1 - math.sin(angle)), low + edge * (1 - math.cos(angle))))
    layers += [(inset, low + high - z) for inset, z in reversed(layers)]
    return loft([[(x, y, z) for x, y in capsule_outline(radius_a - inset, radius_b - inset, length)]
                 for inset, z in layers])


def squircle(half_x, half_y, z, centre=(0.0, 0.0), power=4.0):
    """A rounded rectangle (superellipse) in the plane z."""
    points = []
    for i in range(TURN):
        c, s = math.cos(2 * math.pi * i / TURN), math.sin(2 * math.pi * i / TURN)
        points.append((centre[0] + half_x * math.copysign(abs(c) ** (2 / power), c),
                       centre[1] + half_y * math.copysign(abs(s) ** (2 / power), s), z))
    return points


def beam(sections, edge=0.0, power=4.0):
    """A loft of squircles (z, half_x, half_y[, centre_x]); with an edge, both ends are filleted."""
    rows = [(s[0], s[1], s[2], s[3] if len(s) > 3 else 0.0) for s in sections]
    if edge > 0:
        rounds = [(edge * (1 - math.sin(math.pi / 2 * k / FILLET_STEPS)),
                   edge * (1 - math.cos(math.pi / 2 * k / FILLET_STEPS))) for k in range(FILLET_STEPS + 1)]
        first, last = rows[0], rows[-1]
        rows = ([(first[0] + rise, first[1] - inset, first[2] - inset, first[3]) for inset, rise in rounds] +
                rows[1:-1] +
                [(last[0] - rise, last[1] - inset, last[2] - inset, last[3]) for inset, rise in reversed(rounds)])
    return loft([squircle(a, b, z, (x, 0.0), power) for z, a, b, x in rows])


def smooth(start, end, steps=8):
    """Rows of numbers passing smoothly from one row to another."""
    rows = []
    for k in range(steps + 1):
        t = k / steps
        ease = t * t * (3 - 2 * t)
        rows.append(tuple([start[0] + (end[0] - start[0]) * t] +
                          [a + (b - a) * ease for a, b in zip(start[1:], end[1:])]))
    return rows


# --- placing --------------------------------------------------------------------------------------------------------

def turned(shape, mapping):
    """mapping tells which old coordinate, with which sign, becomes x, y and z; e.g. '+z+x+y' (a pure rotation)."""
    index = {'x': 0, 'y': 1, 'z': 2}
    rule = [(1.0 if mapping[k] == '+' else -1.0, index[mapping[k + 1]]) for k in (0, 2, 4)]
    points, faces = shape
    return [tuple(sign * p[axis] for sign, axis in rule) for p in points], faces


def moved(shape, x=0.0, y=0.0, z=0.0):
    points, faces = shape
    return [(p[0] + x, p[1] + y, p[2] + z) for p in points], faces


def around_y(shape):
    """The shape's z axis becomes y; its x axis becomes z."""
    return turned(shape, '+y+z+x')


def along_x(shape):
    """The shape's z axis becomes x; its x axis becomes y."""
    return turned(shape, '+z+x+y')


def both_sides(make):
    """A pair of shapes mirrored in y: make(low, high) is called for either side."""
    return lambda low, high: [make(low, high), make(-high, -low)]


# --- the arm --------------------------------------------------------------------------------------------------------

SHOULDER = 0.215  # height of the shoulder axis above the table
UPPER = 0.32      # shoulder axis to elbow axis
FORE = 0.30       # elbow axis to wrist axis


def parts():
    ring = lambda radius, low, high: drum(radius, low, high, 0.0015)
    base = [lathe([(0, 0), (0.088, 0), (0.088, 0.018), (0.070, 0.026), (0.061, 0.098), (0, 0.098)], 0.008)]
    base_trim = [ring(0.0585, 0.094, 0.104)]
    base_trim += [moved(drum(0.0055, 0.010, 0.0205, 0.0015, 16), 0.077 * math.cos(a), 0.077 * math.sin(a))
                  for a in [math.pi / 4 + k * math.pi / 2 for k in range(4)]]

    shoulder = [lathe([(0, 0.104), (0.061, 0.104), (0.061, 0.132), (0.050, 0.160), (0, 0.160)], 0.010),
                beam(smooth((0.140, 0.050, 0.043), (SHOULDER, 0.052, 0.036)), 0.0, 3.5),
                moved(around_y(drum(0.055, -0.036, 0.036, 0.005)), z=SHOULDER)]

    # Plates lie in the xz plane of the body: x of the outline runs along the link.
    cheeks = both_sides(lambda low, high: around_y(plate(0.056, 0.048, UPPER, low, high, 0.006)))
    upper = cheeks(0.0375, 0.0585)
    upper += [beam([(0.075, 0.030, 0.045)] + smooth((0.09, 0.036, 0.045), (UPPER - 0.08, 0.031, 0.045)) +
                   [(UPPER - 0.065, 0.025, 0.045)], 0.0, 5.0)]
    upper_trim = []
    for z, radius in ((0.0, 0.040), (UPPER, 0.033)):
        for side in both_sides(lambda low, high: around_y(ring(radius, low, high)))(0.050, 0.0625):
            upper_trim.append(moved(side, z=z))

    forward = lambda shape: turned(shape, '+x-z+y')
    fore = [around_y(drum(0.046, -0.036, 0.036, 0.005)),
            along_x(beam([(0.020, 0.034, 0.040)] + smooth((0.045, 0.034, 0.040), (FORE - 0.075, 0.031, 0.029)) +
                         [(FORE - 0.050, 0.031, 0.026)], 0.0, 3.2))]
    fore += [moved(side, x=FORE - 0.075) for side in
             both_sides(lambda low, high: forward(plate(0.028, 0.033, 0.075, low, high, 0.004)))(0.0255, 0.0375)]
    fore_trim = [moved(side, x=FORE) for side in
                 both_sides(lambda low, high: around_y(ring(0.022, low, high)))(0.032, 0.0405)]
    fore_trim += [along_x(beam([(0.130, 0.0352, 0.0374), (0.140, 0.0350, 0.0368)], 0.0, 3.2))]

    wrist = [around_y(drum(0.030, -0.0245, 0.0245, 0.004)),
             beam([(-0.034, 0.022, 0.022), (0.0, 0.024, 0.0235)], 0.0, 3.0)]
    tilt = [lathe([(0, -0.060), (0.029, -0.060), (0.029, -0.040), (0.024, -0.034), (0, -0.034)], 0.005),
            ]
    # The hand hangs down from the tool flange; the fingers slide along x.
    hand = [beam([(-0.098, 0.066, 0.026), (-0.090, 0.066, 0.027)] +
                 smooth((-0.084, 0.066, 0.028), (-0.066, 0.032, 0.028), 6) + [(-0.063, 0.030, 0.027)], 0.003, 5.0)]
    hand_trim = [beam([(-0.104, 0.063, 0.0125), (-0.092, 0.063, 0.0125)], 0.001, 8.0),
                 ring(0.0255, -0.0655, -0.0585)]

    # One finger, its pad facing -x at x = 0 and its tip at z = 0 (the palm is above); the other one is turned by half.
    carriage = beam([(0.076, 0.011, 0.013, 0.011), (0.090, 0.011, 0.013, 0.011)], 0.0025, 6.0)
    blade = beam([(0.000, 0.0035, 0.0100, 0.0065), (0.010, 0.0038, 0.0108, 0.0070)] +
                 smooth((0.034, 0.0042, 0.0112, 0.0074), (0.066, 0.0080, 0.0120, 0.0110), 8) +
                 [(0.080, 0.0085, 0.0120, 0.0115)], 0.0018, 6.0)
    pad = beam([(0.000, 0.0020, 0.0098, 0.0020), (0.0365, 0.0020, 0.0098, 0.0020)], 0.0008, 8.0)
    return {'base': base, 'base_trim': base_trim, 'shoulder': shoulder, 'upper_arm': upper,
            'upper_arm_trim': upper_trim, 'forearm': fore, 'forearm_trim': fore_trim, 'wrist': wrist,
            'wrist_tilt': tilt, 'hand': hand, 'hand_trim': hand_trim, 'finger': [carriage, blade],
            'finger_pad': [pad]}


def write_obj(path, name, shapes):
    lines = [f'# aerascope tabletop arm: {name} (made by make_meshes.py)']
    first = 1
    for number, (points, faces) in enumerate(shapes):
        lines.append(f'o {name}_{number}')
        lines += ['v ' + ' '.join(f'{c:.5f}'.replace('-0.00000', '0.00000') if abs(c) < 5e-6 else f'{c:.5f}' for c in p) for p in points]
        lines += ['f ' + ' '.join(str(i + first) for i in face) for face in faces]
        first += len(points)
    with open(path, 'w', encoding='ascii', newline='\n') as file:
        file.write('\n'.join(lines) + '\n')


def signed_volume(shape):
    points, faces = shape
    total = 0.0
    for a, b, c in faces:
        p, q, r = points[a], points[b], points[c]
        total += (p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
                  p[2] * (q[0] * r[1] - q[1] * r[0])) / 6
    return total


def main():
    folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'meshes')
    os.makedirs(folder, exist_ok=True)
    for name, shapes in parts().items():
        outward = []
        for points, faces in shapes:
            if signed_volume((points, faces)) < 0:
                faces = [(a, c, b) for a, b, c in faces]
            outward.append((points, faces))
        write_obj(os.path.join(folder, name + '.obj'), name, outward)


if __name__ == '__main__':
    main()
