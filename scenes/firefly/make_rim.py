#!/usr/bin/python3
"""Writes rim.obj: the ring of the magnifying glass, radius 1 around the z axis, as a torus of 64 x 10 quads."""
import math
import pathlib

SEGMENTS, SIDES, THICKNESS = 64, 10, 0.045

lines = ["# Written by make_rim.py"]
for i in range(SEGMENTS):
    phi = 2 * math.pi * i / SEGMENTS
    for j in range(SIDES):
        theta = 2 * math.pi * j / SIDES
        radius = 1 + THICKNESS * (1 + math.cos(theta))
        x, y, z = radius * math.cos(phi), radius * math.sin(phi), 1.6 * THICKNESS * math.sin(theta)
        lines.append(f"v {x:.5f} {y:.5f} {z:.5f}")
for i in range(SEGMENTS):
    for j in range(SIDES):
        a, b = i * SIDES + j + 1, i * SIDES + (j + 1) % SIDES + 1
        c, d = (i + 1) % SEGMENTS * SIDES + j + 1, (i + 1) % SEGMENTS * SIDES + (j + 1) % SIDES + 1
        lines.append(f"f {a} {c} {d} {b}")
pathlib.Path(__file__).with_name("rim.obj").write_text("\n".join(lines) + "\n")
