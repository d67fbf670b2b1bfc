# {{GRAIN_NAME}} on {{WALL_NAME}}: clump, contact law, engines. The other scripts begin by running it.
# Written by {{PROGRAM}} from the study {{STUDY}} ({{HASH}}).
{{#FITTED}}
#   {{NAME}} {{VALUE}}, {{INTERVAL}}: {{VERDICT}}
{{/FITTED}}
from math import atan, cbrt, cos, pi, radians, sin, sqrt
from yade import Body, Matrix3, O, Quaternion, Vector3, utils
from yade.wrapper import *
#
# Spheres of one grain: centre and radius, m, relative to the centre of mass, along the principal axes.
SPHERES = [
{{#BALL}}
    (({{X}}, {{Y}}, {{Z}}), {{R}}),
{{/BALL}}
]
MASS = {{MASS}}  # kg, and moments of inertia, kg m^2: of the surface, not of the spheres
INERTIA = ({{IXX}}, {{IYY}}, {{IZZ}})
REACH = {{REACH}}  # m
GRAVITY = {{GRAVITY}}
#
# Contact with walls and between grains: damping ratios betan, betas (fractions of critical); friction;
# eta, as a fraction of F (R1 + R2) / 2; krot, N m/rad for the stiffness factor 1.
WALL = dict(betan={{WALL_BETAN}}, betas={{WALL_BETAS}}, friction={{WALL_SLIDING}}, eta={{WALL_ETA}}, krot={{WALL_KROT}})
GRAINS = dict(betan={{GRAIN_BETAN}}, betas={{GRAIN_BETAS}}, friction={{GRAIN_SLIDING}}, eta={{GRAIN_ETA}}, krot={{GRAIN_KROT}})
{{#TUBE}}
# Contact with the tube, made of {{TUBE_NAME}}.
TUBE = dict(betan={{TUBE_BETAN}}, betas={{TUBE_BETAS}}, friction={{TUBE_SLIDING}}, eta={{TUBE_ETA}}, krot={{TUBE_KROT}})
{{/TUBE}}
# Moduli that give the grain-wall contact its stiffness, although YADE treats the wall as a sphere of
# the same size: see README.txt.
PAIR = dict(young={{PAIR_YOUNG}}, poisson={{PAIR_POISSON}})
GRAIN = dict(young={{GRAIN_YOUNG}}, poisson={{GRAIN_POISSON}})
DENSITY = {{DENSITY}}
def add_materials(stiffness, moduli):
    for name in ('grain', 'wall'{{#TUBE}}, 'tube'{{/TUBE}}):
        O.materials.append(FrictMat(young=moduli['young'] * stiffness, poisson=moduli['poisson'],
                                    density=DENSITY, frictionAngle=0, label=name))
def matched(value):
    return MatchMaker(matches=((0, 1, value(WALL)), (0, 0, value(GRAINS)){{#TUBE}}, (0, 2, value(TUBE)){{/TUBE}}))
def set_engines(stiffness, rolling, gravity=(0, 0, -GRAVITY), watch=()):
    """rolling: WALL or GRAINS; YADE has only one value for all pairs."""
    contact = Ip2_FrictMat_FrictMat_MindlinPhys(
        betan=matched(lambda pair: pair['betan']),
        betas=matched(lambda pair: pair['betas']),
        frictAngle=matched(lambda pair: atan(pair['friction'])),
        eta=rolling['eta'], krot=rolling['krot'] * stiffness ** (2 / 3), label='contact')
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb(), Bo1_Facet_Aabb()], verletDist=.05 * REACH),
        InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom()],
                        [contact],
                        [Law2_ScGeom_MindlinPhys_Mindlin(includeMoment=rolling['eta'] > 0, label='law')]),
        NewtonIntegrator(gravity=gravity, damping=0, label='newton'),
    ] + list(watch)
def add_grain(at, orientation, spheres=SPHERES, mass=MASS, inertia=INERTIA, velocity=(0, 0, 0)):
    """One rigid grain; returns the number of the body that moves."""
    at = Vector3(*at)
    members = [utils.sphere(at + orientation * Vector3(*centre), radius, material='grain') for centre, radius in spheres]
    if len(members) == 1:
        body = O.bodies[O.bodies.append(members[0])]
        body.state.mass = mass
        body.state.inertia = inertia
    else:
        # The spheres contribute no mass: a box that touches nothing carries all the mass.
        for member in members:
            member.mat = FrictMat(density=1e-12 * DENSITY)
        carrier = utils.box(at, (1e-6, 1e-6, 1e-6), orientation=orientation, material='grain')
        carrier.state.mass = mass
        carrier.state.inertia = inertia
        carrier.bounded = False
        number, parts = O.bodies.appendClumped(members + [carrier], discretization=0)
        for part in parts[:-1]:
            O.bodies[part].mat = O.materials['grain']
            O.bodies[part].state.mass = mass  # determines the damping of its contacts
        body = O.bodies[number]
    body.state.vel = velocity
    return body.id
