# {{BONDED}} bonded grains on a plate that tilts at {{RATE}} degrees per second, until they have slipped 0.5 mm.
#   yade -n -x tilt.py
# Gravity turns instead of the plate, which is equivalent, starting at {{BEGIN}} degrees, at most 3
# degrees before sliding. The reading is the angle at that slip; the onset that repose reports is
# slightly smaller.
exec(open('grain.py').read())
STIFFNESS = {{STIFFNESS}}
RATE = {{RATE}}    # degrees per second
BEGIN = {{BEGIN}}  # degrees
BODY = [  # the bonded grains as one body: centre and radius, m
{{#BALL}}
    (({{X}}, {{Y}}, {{Z}}), {{R}}),
{{/BALL}}
]
add_materials(STIFFNESS, PAIR)
O.bodies.append(utils.wall((0, 0, 0), axis=2, sense=1, material='wall'))
number = add_grain((0, 0, {{HEIGHT}}), Quaternion({{QW}}, {{QX}}, {{QY}}, {{QZ}}), spheres=BODY,
                   mass={{BODY_MASS}}, inertia=({{IXX}}, {{IYY}}, {{IZZ}}))
state = O.bodies[number].state
angle = BEGIN
first = None
def turn():
    global angle, first
    if O.time < .05:
        return  # the grains settle
    if first is None:
        first = (O.time, state.pos[0])
    angle = BEGIN + RATE * (O.time - first[0])
    newton.gravity = (GRAVITY * sin(radians(angle)), 0, -GRAVITY * cos(radians(angle)))
    if state.pos[0] - first[1] > 5e-4 or angle > 89:
        O.pause()
down = (GRAVITY * sin(radians(BEGIN)), 0, -GRAVITY * cos(radians(BEGIN)))
set_engines(STIFFNESS, WALL, gravity=down, watch=[PyRunner(command='turn()', iterPeriod=10)])
O.dt = {{TIMESTEP}}
O.run({{STEPS}}, True)
print('reading: half_mm_slip_deg %.6f' % angle)
