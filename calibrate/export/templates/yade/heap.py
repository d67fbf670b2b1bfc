# {{GRAINS}} grains in a tube that is lifted off a plate at {{LIFT_MM_S}} mm/s: the heap that remains.
#   yade -n -x heap.py
# For a different heap: yade -n -x heap.py SEED.
# heap.txt contains the final spheres (m): README.txt explains how to measure them.
exec(open('grain.py').read())
import random, sys
from yade import geom
STIFFNESS = {{STIFFNESS}}
random.seed(int(sys.argv[1]) if len(sys.argv) > 1 else 1)
add_materials(STIFFNESS, GRAIN)
half = .5 * {{PLATE}}
corners = [(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)]
O.bodies.append(utils.facet([corners[0], corners[1], corners[2]], material='wall'))
O.bodies.append(utils.facet([corners[0], corners[2], corners[3]], material='wall'))
# Tall enough to hold all grains while they fall in; the part above the rim is removed before the lift.
tube = O.bodies.append(geom.facetCylinder((0, 0, .5 * {{TUBE_HEIGHT}}), {{TUBE_RADIUS}}, {{TUBE_HEIGHT}}, segmentsNumber=48, wallMask=4, material='{{TUBE_MATERIAL}}'))
guide = O.bodies.append(geom.facetCylinder((0, 0, {{TUBE_HEIGHT}} + .5 * {{COLUMN}}), {{TUBE_RADIUS}}, {{COLUMN}}, segmentsNumber=48, wallMask=4, material='{{TUBE_MATERIAL}}'))
numbers = []
room = {{TUBE_RADIUS}} - REACH
height = REACH
while len(numbers) < {{GRAINS}}:
    layer = []
    for attempt in range(100):
        radius, turn = room * sqrt(random.random()), 2 * pi * random.random()
        at = (radius * cos(turn), radius * sin(turn), height)
        if all((Vector3(*at) - Vector3(*other)).norm() > 2 * REACH for other in layer):
            layer.append(at)
    for at in layer[:{{GRAINS}} - len(numbers)]:
        turned = Quaternion(random.gauss(0, 1), random.gauss(0, 1), random.gauss(0, 1), random.gauss(0, 1))
        turned.normalize()
        numbers.append(add_grain(at, turned))
    height += 2.02 * REACH
set_engines(STIFFNESS, GRAINS)
O.dt = {{TIMESTEP}}
O.run({{FILL_STEPS}}, True)
for number in guide:
    O.bodies.erase(number)
for number in tube:
    O.bodies[number].state.vel = (0, 0, {{LIFT}})
O.run({{LIFT_STEPS}}, True)
for number in tube:
    O.bodies[number].state.vel = (0, 0, 0)
O.run({{REST_STEPS}}, True)
with open('heap.txt', 'w') as out:
    out.write('x [m],y [m],z [m],radius [m]\n')
    for body in O.bodies:
        if isinstance(body.shape, Sphere) and body.state.pos[2] > -REACH:
            x, y, z = body.state.pos
            out.write('%.9g,%.9g,%.9g,%.9g\n' % (x, y, z, body.shape.radius))
