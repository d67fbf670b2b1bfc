# A grain released {{RELEASE_MM}} mm up an incline of {{INCLINE}} degrees, which ends on a flat plate.
#   yade -n -x roll.py
# The reading is the distance of its centre of mass from the foot (x = 0) when it has come to rest.
exec(open('grain.py').read())
STIFFNESS = {{STIFFNESS}}
add_materials(STIFFNESS, PAIR)
O.bodies.append(utils.wall((0, 0, 0), axis=2, sense=1, material='wall'))
incline = O.bodies.append(utils.facet([(0, {{HALF_FOOT}}, 0), ({{APEX_X}}, 0, {{APEX_Z}}), (0, -{{HALF_FOOT}}, 0)], material='wall'))
number = add_grain(({{X}}, {{Y}}, {{Z}}), Quaternion({{QW}}, {{QX}}, {{QY}}, {{QZ}}))
state = O.bodies[number].state
place = state.pos[0]
def level():
    """YADE treats a facet as a sphere twice as large, a wall as one of equal size: makes them equal."""
    for contact in O.interactions:
        if contact.isReal and incline in (contact.id1, contact.id2):
            limit = WALL['eta'] * contact.geom.refR2
            if contact.phys.maxBendPl > 1.1 * limit:
                contact.phys.kno *= sqrt(3 / 4)
                contact.phys.kso *= sqrt(3 / 4)
                contact.phys.maxBendPl = limit
def rest():
    global place
    if abs(state.pos[0] - place) < 1e-3 * REACH:
        O.pause()
    place = state.pos[0]
set_engines(STIFFNESS, WALL, watch=[PyRunner(command='level()', iterPeriod=5),
                                    PyRunner(command='rest()', iterPeriod={{EVERY}}, initRun=False)])
O.dt = {{TIMESTEP}}
O.run({{STEPS}}, True)
print('reading: roll_mm %.6f' % (1000 * state.pos[0]))
