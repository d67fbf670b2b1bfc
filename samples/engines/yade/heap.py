"""A heap in YADE: yade -n -x heap.py FOLDER. Spheres fall into a tube, which is lifted off a plate."""
import json
import math
import os
import random
import sys

from yade import O, Vector3, geom, utils
from yade.wrapper import *

YOUNG_PA, POISSON = 2e6, 0.3
ROLLING_STIFFNESS = 0.05  # N m/rad
DAMPING = 0.2             # fraction of critical
LIFT_M_S = 0.05
TIMESTEP_S = 1e-4

folder = sys.argv[-1]
with open(os.path.join(folder, "run.json"), encoding="utf-8") as file:
    run = json.load(file)
values = {**run["settings"], **run["parameters"]}
radius, tube_radius = values["radius_m"], values["tube_radius_m"]
random.seed(run["seed"])

for name in ("grain", "plate"):
    O.materials.append(FrictMat(young=YOUNG_PA, poisson=POISSON, density=values["density_kg_m3"], frictionAngle=0,
                                label=name))
O.bodies.append(utils.wall((0, 0, 0), axis=2, material="plate"))
height = 0.4
tube = O.bodies.append(geom.facetCylinder((0, 0, height / 2 + 0.0005), tube_radius, height, segmentsNumber=48, wallMask=4,
                                          material="grain"))
z, made = 1.2 * radius, 0
while made < values["grains"]:
    layer = []
    for attempt in range(100):
        far, turn = (tube_radius - 1.1 * radius) * math.sqrt(random.random()), 2 * math.pi * random.random()
        at = Vector3(far * math.cos(turn), far * math.sin(turn), z)
        if all((at - other).norm() > 2 * radius for other in layer):
            layer.append(at)
    for at in layer[:values["grains"] - made]:
        O.bodies.append(utils.sphere(at, radius, material="grain"))
        made += 1
    z += 2.02 * radius

angles = MatchMaker(matches=((0, 0, math.atan(values["sliding"])), (0, 1, math.atan(values["plate_sliding"]))))
contact = Ip2_FrictMat_FrictMat_MindlinPhys(
    betan=MatchMaker(matches=((0, 0, DAMPING), (0, 1, DAMPING))), betas=MatchMaker(matches=((0, 0, DAMPING), (0, 1, DAMPING))),
    frictAngle=angles, eta=values["rolling"], krot=ROLLING_STIFFNESS)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb(), Bo1_Facet_Aabb()], verletDist=0.1 * radius),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom()], [contact],
                    [Law2_ScGeom_MindlinPhys_Mindlin(includeMoment=values["rolling"] > 0)]),
    NewtonIntegrator(gravity=(0, 0, -9.80665), damping=0),
]
O.dt = TIMESTEP_S
O.run(int(0.4 / O.dt), True)
for number in tube:
    O.bodies[number].state.vel = (0, 0, LIFT_M_S)
O.run(int(0.1 / LIFT_M_S / O.dt), True)
for number in tube:
    O.bodies.erase(number)
O.run(int(0.2 / O.dt), True)

with open(os.path.join(folder, "heap.csv"), "w", encoding="utf-8") as file:
    file.write("x [m],y [m],z [m],radius [m]\n")
    for body in O.bodies:
        if isinstance(body.shape, Sphere):
            x, y, z = body.state.pos
            file.write(f"{x:.9g},{y:.9g},{z:.9g},{radius}\n")
with open(os.path.join(folder, "reading.json"), "w", encoding="utf-8") as file:
    json.dump({"aor": "heap.csv"}, file)
