# S2 for YADE's polyhedra (contact by overlap volume): yade -j1 -n -x s2.yade.py PARTICLES SETTLE WINDOW
# PARTICLES is the table of write_particles. A step takes half a second once the bodies lie on each other, so PARTICLES
# should be of a settled scene, and SETTLE and WINDOW a few steps. Prints the CPU clock at each window's ends.
import math
import os
import sys

from yade import polyhedra_utils

particles, settle, window = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])

# Force is young / 2 times the volume, as stiff as Talus has S2 [N/m3].
stone = PolyhedraMat(density=2500, young=3.2e9, poisson=0.3, frictionAngle=math.atan(0.5))
shapes = []
for line in open(particles):
    words = line.split()
    if words[0] == '#':
        x = [float(w) for w in words[1:]]
        shapes.append([Vector3(*x[i:i + 3]) for i in range(0, len(x), 3)])
        continue
    x = [float(w) for w in words[1:]]
    turn = Quaternion(x[3], x[4], x[5], x[6])
    body = polyhedra_utils.polyhedra(stone, v=[turn * v for v in shapes[int(words[0])]])
    body.state.pos = Vector3(x[0], x[1], x[2])
    O.bodies.append(body)
for axis, place, sense in ((0, 0.0, 1), (0, 0.12, -1), (1, 0.0, 1), (1, 0.12, -1), (2, 0.0, 1)):
    O.bodies.append(utils.wall(place, axis, sense, material=stone))

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Polyhedra_Aabb(), Bo1_Wall_Aabb()], verletDist=0.0005),
    InteractionLoop(
        [Ig2_Wall_Polyhedra_PolyhedraGeom(), Ig2_Polyhedra_Polyhedra_PolyhedraGeom()],
        [Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
        [Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()]),
    NewtonIntegrator(damping=0.3, gravity=(0, 0, -9.81)),
]
O.dt = 1e-5


def report():
    grains = [b for b in O.bodies if isinstance(b.shape, Polyhedra)]
    height = sum(b.state.pos[2] for b in grains) / len(grains)
    touching = sum(1 for i in O.interactions if i.isReal)
    print('step %d, mean height %.6f, contacts %d' % (O.iter, height, touching))


def clock():
    times = os.times()
    print('cpu %.2f' % (times.user + times.system), flush=True)


O.run(settle, wait=True)
for _ in range(3):
    clock()
    O.run(window, wait=True)
clock()
report()
