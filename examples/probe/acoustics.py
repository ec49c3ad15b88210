"""Sound in two dimensions on a staggered grid, one leapfrog step, for `courant probe`.

The pressure p stands in the middle of a cell, u and v on its right and upper side; C = c dt/dx, rho = c = 1.

    courant probe --unknowns p,u,v --size 16,16 -- python3 examples/probe/acoustics.py {in} {out} {C}
"""

import sys

import numpy as np

read, write, courant = sys.argv[1], sys.argv[2], float(sys.argv[3])
p, u, v = np.load(read)
u = u - courant * (np.roll(p, -1, axis=0) - p)
v = v - courant * (np.roll(p, -1, axis=1) - p)
p = p - courant * (u - np.roll(u, 1, axis=0) + v - np.roll(v, 1, axis=1))
np.save(write, np.stack([p, u, v]))
