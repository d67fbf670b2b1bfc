# Drop from {{HEIGHT_MM}} mm onto a wall. Grains: {{GRAINS}}, far apart, each with its own orientation.
#   yade -n -x drop.py
# Each grain starts in contact, with the speed gained in the fall. The reading is the top of the first
# flight minus the lowest height before it, averaged over the grains.
exec(open('grain.py').read())
STIFFNESS = {{STIFFNESS}}
SPEED = {{SPEED}}  # m/s
POSES = [  # height of the centre of mass (m), orientation w x y z
{{#POSE}}
    ({{HEIGHT}}, ({{QW}}, {{QX}}, {{QY}}, {{QZ}})),
{{/POSE}}
]
add_materials(STIFFNESS, PAIR)
O.bodies.append(utils.wall((0, 0, 0), axis=2, sense=1, material='wall'))
grains = []
for k, (height, (w, x, y, z)) in enumerate(POSES):
    turned = Quaternion(w, x, y, z)
    number = add_grain((k * {{SPACING}}, 0, height), turned, velocity=(0, 0, -SPEED))
    grains.append(dict(number=number, lowest=height, rising=False, rise=None))
def touches(number):
    body = O.bodies[number]
    parts = body.shape.members.keys() if body.isClump else [number]
    return any(contact.isReal for part in parts for contact in O.bodies[part].intrs())
def watch():
    for grain in grains:
        if grain['rise'] is not None:
            continue
        state = O.bodies[grain['number']].state
        grain['lowest'] = min(grain['lowest'], state.pos[2])
        if state.vel[2] > 0:
            grain['rising'] = True
        elif grain['rising']:
            grain['rising'] = False
            if not touches(grain['number']):
                grain['rise'] = state.pos[2] - grain['lowest']
    if all(grain['rise'] is not None for grain in grains):
        O.pause()
set_engines(STIFFNESS, WALL, watch=[PyRunner(command='watch()', iterPeriod={{EVERY}})])
O.dt = {{TIMESTEP}}
O.run({{STEPS}}, True)
rises = [1000 * (grain['rise'] or 0) for grain in grains]
print('rises [mm]:', ' '.join('%.4f' % rise for rise in rises))
print('reading: drop_mm %.6f' % (sum(rises) / len(rises)))
