"""First-order upwind advection as a filter of .npy files, for `courant probe`.

    courant probe -- python3 examples/probe/upwind.py {in} {out} {C}
"""

import sys

import numpy as np

read, write, courant = sys.argv[1], sys.argv[2], float(sys.argv[3])
u = np.load(read)
np.save(write, u - courant * (u - np.roll(u, 1)))
