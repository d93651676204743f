# S1 box for YADE, the same work as Talus does: yade -j1 -n -x s1_box.yade.py PARTICLES SETTLE WINDOW
# PARTICLES is the table of write_particles; Hertz-Mindlin, one thread. Prints the CPU clock at each window's ends.
import math
import os
import sys

particles, settle, window = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])

stone = O.materials.append(
    FrictMat(young=5e6, poisson=0.3, density=2500, frictionAngle=math.atan(0.5)))
radius = None
for line in open(particles):
    words = line.split()
    if words[0] == '#':
        radius = float(words[2])
    else:
        O.bodies.append(utils.sphere([float(x) for x in words[1:4]], radius, material=stone))
for axis, place, sense in ((0, 0.0, 1), (0, 0.2, -1), (1, 0.0, 1), (1, 0.2, -1), (2, 0.0, 1)):
    O.bodies.append(utils.wall(place, axis, sense, material=stone))

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.0005),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
        [Ip2_FrictMat_FrictMat_MindlinPhys(en=MatchMaker(algo='val', val=0.5),
                                           es=MatchMaker(algo='val', val=0.5))],
        [Law2_ScGeom_MindlinPhys_Mindlin()]),
    NewtonIntegrator(damping=0, gravity=(0, 0, -9.81)),
]
O.dt = 1e-4


def report():
    spheres = [b for b in O.bodies if isinstance(b.shape, Sphere)]
    height = sum(b.state.pos[2] for b in spheres) / len(spheres)
    pairs = sum(1 for i in O.interactions
                if i.isReal and all(isinstance(O.bodies[k].shape, Sphere) for k in (i.id1, i.id2)))
    print('step %d, mean height %.6f, coordination %.4f' % (O.iter, height, 2.0 * pairs / len(spheres)))


def clock():
    times = os.times()
    print('cpu %.2f' % (times.user + times.system), flush=True)


O.run(settle, wait=True)
for _ in range(3):
    clock()
    O.run(window, wait=True)
clock()
report()
