#!/usr/bin/env python3
"""A small path tracer in Python, served to the explorer.

A room with a lamp, and three balls in it: matt, mirror and glass. Start it, then open the explorer:

    python3 examples/smallpt.py --port 50013 &
    emca-explorer 127.0.0.1:50013

Lines that begin with `rec.` are all that recording needs; compare Algorithm 1 of the EMCA paper and minimal_renderer.cpp.
"""

import argparse
import math
import random
from dataclasses import dataclass

import numpy as np

import emca

# ---- Vectors are tuples of three floats.


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def mul(a, b):
    return (a[0] * b[0], a[1] * b[1], a[2] * b[2])


def scale(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalize(a):
    return scale(a, 1 / math.sqrt(dot(a, a)))


def luminance(c):
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]


def frame(n):
    """Two unit vectors that make an orthonormal basis with the unit vector n."""
    helper = (1.0, 0.0, 0.0) if abs(n[0]) < 0.7 else (0.0, 1.0, 0.0)
    s = normalize(cross(n, helper))
    return s, cross(n, s)


def to_world(n, x, y, z):
    s, t = frame(n)
    return add(add(scale(s, x), scale(t, y)), scale(n, z))


# ---- The scene: the inside of a box, and balls.

BLACK, WHITE = (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)
ROOM_MIN, ROOM_MAX = (-1.5, 0.0, -1.5), (1.5, 2.4, 4.5)
# By axis and side: left, right; floor, ceiling; back, front.
WALLS = [("left", (0.7, 0.25, 0.2)), ("right", (0.2, 0.35, 0.7)), ("floor", (0.7, 0.7, 0.7)), ("ceiling", (0.7, 0.7, 0.7)),
         ("back", (0.7, 0.7, 0.6)), ("front", (0.5, 0.5, 0.5))]
RINGS, SEGMENTS = 16, 32  # of a ball's triangles
EPSILON = 1e-6


@dataclass(frozen=True)
class Ball:
    name: str
    centre: tuple
    radius: float
    material: str  # "matt", "mirror", "glass" or "lamp"
    color: tuple = WHITE
    emission: tuple = BLACK


BALLS = [Ball("matt", (-0.8, 0.45, -0.3), 0.45, "matt", (0.65, 0.6, 0.3)),
         Ball("mirror", (0.25, 0.5, -0.7), 0.5, "mirror", (0.9, 0.9, 0.9)),
         Ball("glass", (0.75, 0.35, 0.5), 0.35, "glass"),
         Ball("lamp", (0.0, 2.05, 0.0), 0.2, "lamp", BLACK, (28.0, 26.0, 22.0))]
LAMP = BALLS[3]
GLASS_IOR = 1.5


@dataclass
class Hit:
    distance: float
    position: tuple = BLACK
    normal: tuple = BLACK  # outwards of a ball, inwards of the room
    color: tuple = BLACK
    material: str = "matt"
    emission: tuple = BLACK
    mesh: int = 0
    face: int = 0


def nearest_ball(origin, direction, limit):
    best = None
    for index, ball in enumerate(BALLS):
        to_centre = sub(ball.centre, origin)
        along = dot(to_centre, direction)
        root = ball.radius * ball.radius - dot(to_centre, to_centre) + along * along
        if root < 0:
            continue
        root = math.sqrt(root)
        for t in (along - root, along + root):
            if 1e-4 < t < limit:
                best, limit = index, t
                break
    return best, limit


def wall(origin, direction):
    """Distance and index of the wall that a ray inside the room meets."""
    best, limit = 0, math.inf
    for axis in range(3):
        if abs(direction[axis]) < 1e-12:
            continue
        side = 1 if direction[axis] > 0 else 0
        t = ((ROOM_MAX if side else ROOM_MIN)[axis] - origin[axis]) / direction[axis]
        if t < limit:
            best, limit = 2 * axis + side, t
    return best, limit


def ball_face(normal):
    """The triangle of a ball's mesh at a normal; see ball_mesh."""
    ring = min(RINGS - 1, int(math.acos(max(-1.0, min(1.0, normal[1]))) / math.pi * RINGS))
    segment = int((math.atan2(normal[2], normal[0]) / (2 * math.pi) % 1.0) * SEGMENTS) % SEGMENTS
    return 2 * (ring * SEGMENTS + segment)


def intersect(origin, direction):
    index, limit = wall(origin, direction)
    ball, t = nearest_ball(origin, direction, limit)
    position = add(origin, scale(direction, t))
    if ball is None:
        axis, side = divmod(index, 2)
        normal = tuple((-1.0 if side else 1.0) if i == axis else 0.0 for i in range(3))
        return Hit(t, position, normal, WALLS[index][1], mesh=index)
    chosen = BALLS[ball]
    normal = scale(sub(position, chosen.centre), 1 / chosen.radius)
    return Hit(t, position, normal, chosen.color, chosen.material, chosen.emission, len(WALLS) + ball, ball_face(normal))


# ---- Scattering: each returns direction, weight (f cos / pdf), pdf.


def scatter_matt(hit, facing, rng):
    u, v = rng.random(), rng.random()
    r, phi = math.sqrt(u), 2 * math.pi * v
    z = math.sqrt(1 - u)
    return to_world(facing, r * math.cos(phi), r * math.sin(phi), z), hit.color, z / math.pi


def mirrored(direction, normal):
    return sub(direction, scale(normal, 2 * dot(direction, normal)))


def fresnel(cos_i, eta):
    """Reflectance of a smooth dielectric, and the cosine of the refracted direction; eta: from over to."""
    sin2_t = eta * eta * (1 - cos_i * cos_i)
    if sin2_t >= 1:
        return 1.0, 0.0
    cos_t = math.sqrt(1 - sin2_t)
    parallel = (cos_i - eta * cos_t) / (cos_i + eta * cos_t)
    perpendicular = (eta * cos_i - cos_t) / (eta * cos_i + cos_t)
    return 0.5 * (parallel * parallel + perpendicular * perpendicular), cos_t


def scatter_glass(direction, normal, rng):
    entering = dot(direction, normal) < 0
    facing = normal if entering else scale(normal, -1)
    eta = 1 / GLASS_IOR if entering else GLASS_IOR
    cos_i = -dot(direction, facing)
    reflectance, cos_t = fresnel(cos_i, eta)
    if rng.random() < reflectance:
        return mirrored(direction, facing), "reflect"
    return normalize(add(scale(direction, eta), scale(facing, eta * cos_i - cos_t))), "transmit"


def sample_lamp(position, rng):
    """A direction into the cone under which the lamp is seen: direction, pdf per steradian, point on the lamp."""
    to_lamp = sub(LAMP.centre, position)
    distance2 = dot(to_lamp, to_lamp)
    cos_max = math.sqrt(max(0.0, 1 - LAMP.radius * LAMP.radius / distance2))
    cos_theta = 1 - rng.random() * (1 - cos_max)
    sin_theta, phi = math.sqrt(max(0.0, 1 - cos_theta * cos_theta)), 2 * math.pi * rng.random()
    direction = to_world(normalize(to_lamp), sin_theta * math.cos(phi), sin_theta * math.sin(phi), cos_theta)
    along = dot(to_lamp, direction)
    t = along - math.sqrt(max(0.0, LAMP.radius * LAMP.radius - distance2 + along * along))
    return direction, 1 / (2 * math.pi * (1 - cos_max)), add(position, scale(direction, t))


# ---- The path tracer.


def trace(origin, direction, rng, max_depth):
    rec = emca.recorder()
    radiance, throughput = BLACK, WHITE
    sees_lamp = True  # the lamp counts where next-event estimation cannot find it
    for depth in range(1, max_depth + 1):
        hit = intersect(origin, direction)
        rec.set_depth_index(depth)
        rec.set_intersection_pos(hit.position)
        rec.set_intersection_surface(hit.mesh, hit.face)
        rec.set_intersection_emission(hit.emission)
        if hit.material == "lamp":
            rec.set_intersection_event("emission", label="lamp")
            if sees_lamp:
                light = mul(throughput, hit.emission)
                radiance = add(radiance, light)
                rec.add_contribution(light, "BSDF sampling", 1.0)
            rec.set_intersection_estimate(radiance)
            break
        if hit.material == "matt":
            facing = hit.normal if dot(direction, hit.normal) < 0 else scale(hit.normal, -1)
            to_lamp, pdf, on_lamp = sample_lamp(hit.position, rng)
            cosine = dot(to_lamp, facing)
            if cosine > 0:
                offset = add(hit.position, scale(facing, EPSILON))
                visible = intersect(offset, to_lamp).material == "lamp"
                rec.set_next_event_estimation_pos(on_lamp, visible)
                if visible:
                    light = mul(mul(throughput, hit.color), scale(LAMP.emission, cosine / (math.pi * pdf)))
                    radiance = add(radiance, light)
                    rec.add_contribution(light, "light sampling", 1.0)
            direction, weight, pdf = scatter_matt(hit, facing, rng)
            rec.set_intersection_event("reflect", "diffuse", hit.material)
            rec.add_intersection_data("BSDF pdf", pdf)
            sees_lamp = False
        else:
            if hit.material == "mirror":
                direction, event = mirrored(direction, hit.normal), "reflect"
            else:
                direction, event = scatter_glass(direction, hit.normal, rng)
            rec.set_intersection_event(event, "specular", hit.material)
            weight, sees_lamp = hit.color, True
        rec.set_intersection_estimate(radiance)
        throughput = mul(throughput, weight)
        rec.add_intersection_data("throughput", emca.Color(*throughput))
        if depth >= 4:  # Russian roulette
            survival = min(0.95, luminance(throughput))
            if rng.random() >= survival:
                break
            throughput = scale(throughput, 1 / survival)
        origin = add(hit.position, scale(direction, EPSILON))
    rec.set_final_estimate(radiance)
    return radiance


# ---- The adapter.


def ball_mesh(ball):
    theta = np.linspace(0, math.pi, RINGS + 1)[:, None]
    phi = np.linspace(0, 2 * math.pi, SEGMENTS, endpoint=False)[None, :]
    unit = np.stack(np.broadcast_arrays(np.sin(theta) * np.cos(phi), np.cos(theta), np.sin(theta) * np.sin(phi)), axis=-1)
    ring, segment = np.mgrid[0:RINGS, 0:SEGMENTS]
    a, b = ring * SEGMENTS + segment, ring * SEGMENTS + (segment + 1) % SEGMENTS
    triangles = np.stack([a, b, a + SEGMENTS, b, b + SEGMENTS, a + SEGMENTS], axis=-1).reshape(-1, 3)
    positions = np.asarray(ball.centre) + ball.radius * unit.reshape(-1, 3)
    return emca.Mesh(positions, triangles, ball.name, ball.material, diffuse=ball.color, emission=ball.emission)


def wall_mesh(index):
    axis, side = divmod(index, 2)
    u, v = (axis + 1) % 3, (axis + 2) % 3
    corners = np.empty((4, 3))
    corners[:, axis] = (ROOM_MAX if side else ROOM_MIN)[axis]
    corners[:, u] = [ROOM_MIN[u], ROOM_MAX[u], ROOM_MAX[u], ROOM_MIN[u]]
    corners[:, v] = [ROOM_MIN[v], ROOM_MIN[v], ROOM_MAX[v], ROOM_MAX[v]]
    triangles = [(0, 2, 1), (0, 3, 2)] if side else [(0, 1, 2), (0, 2, 3)]  # seen from inside
    return emca.Mesh(corners, triangles, WALLS[index][0], "matt", diffuse=WALLS[index][1])


class SmallPathTracer(emca.Renderer):
    def __init__(self, width=64, height=48, spp=8, max_depth=12):
        self.size, self.spp, self.max_depth = (width, height), spp, max_depth
        self.view = emca.Camera(position=(0.0, 1.1, 4.2), direction=(0.0, -0.05, -1.0), vertical_field_of_view=40.0)

    def info(self):
        # In several threads at once: a click is answered while the image renders.
        return emca.RendererInfo(*self.size, renderer="smallpt.py", scene="a room", samples_per_pixel=self.spp, integrator="path",
                                 sampler="independent", concurrent=True)

    def camera(self):
        return self.view

    def meshes(self):
        return [wall_mesh(i) for i in range(len(WALLS))] + [ball_mesh(ball) for ball in BALLS]

    def camera_ray(self, pixel, rng):
        (width, height), forward = self.size, normalize(self.view.direction)
        right = normalize(cross(forward, self.view.up))
        up = cross(right, forward)
        extent = math.tan(math.radians(self.view.vertical_field_of_view) / 2)
        x = (2 * (pixel[0] + rng.random()) / width - 1) * extent * width / height
        y = (1 - 2 * (pixel[1] + rng.random()) / height) * extent
        return self.view.position, normalize(add(forward, add(scale(right, x), scale(up, y))))

    def samples(self, pixel, settings):
        """The values of all paths of a pixel, (samples, 3): the one function that renders and replays."""
        rec = emca.recorder()
        seeds = emca.SeedMap(settings.seed)
        values = np.empty((settings.samples_per_pixel, 3))
        for sample in range(settings.samples_per_pixel):
            rng = random.Random(seeds.seed(pixel, sample))
            rec.set_path_index(sample)
            origin, direction = self.camera_ray(pixel, rng)
            rec.set_path_origin(origin)
            values[sample] = trace(origin, direction, rng, self.max_depth)
        return values

    def render_image(self, settings, monitor):
        width, height = self.size
        color, variance = np.zeros((height, width, 3)), np.zeros((height, width, 3))
        for y in range(height):
            if monitor.cancelled:
                raise emca.Cancelled()
            for x in range(width):
                values = self.samples((x, y), settings)
                color[y, x] = values.mean(axis=0)
                if len(values) > 1:
                    variance[y, x] = values.var(axis=0, ddof=1)
            monitor.preview(0, y, color[y:y + 1])
            monitor.progress((y + 1) / height)
        return color, np.full((height, width), settings.samples_per_pixel), variance

    def render_pixel(self, pixel, settings, recording, monitor):
        return self.samples(pixel, settings).mean(axis=0)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--port", type=int, default=50013, help="0: any")
    arguments.add_argument("--size", default="64x48", help="of the image, e.g. 64x48")
    arguments.add_argument("--spp", type=int, default=8, help="samples per pixel")
    given = arguments.parse_args()
    width, height = map(int, given.size.split("x"))
    with emca.serve(SmallPathTracer(width, height, given.spp), port=given.port, allow_quit=True) as server:
        print(f"listening on {server.address}", flush=True)
        try:
            server.wait()
        except KeyboardInterrupt:
            pass


if __name__ == "__main__":
    main()
