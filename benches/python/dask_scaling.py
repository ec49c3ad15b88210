"""A sweep of limits on a cluster of one process and of two, each with one thread: `python dask_scaling.py LIMITS BLOCK`.

Prints seconds on the clock, those of all processors, and the share of a processor that each process had: on a busy machine that is what limits it.
"""

import os
import sys
import time

os.environ["RAYON_NUM_THREADS"] = "1"

import numpy as np
from distributed import Client, LocalCluster

import courant_stability as courant
import courant_stability.dask

SCHEME = courant.Scheme("u[n+1,j] = u[n,j] - C/2*(u[n,j+1] - u[n,j-1]) + r*(u[n,j+1] - 2*u[n,j] + u[n,j-1])")


def sweep(values, block):
    return courant.dask.limits_table(SCHEME, r=values, chunks=block)["value"].compute()


if __name__ == "__main__":
    limits, block = int(sys.argv[1]), int(sys.argv[2])
    values = np.round(np.linspace(0.001, 0.5, limits), 9)
    for processes in (1, 2, 1, 2):
        cluster = LocalCluster(n_workers=processes, threads_per_worker=1, dashboard_address=None)
        with cluster, Client(cluster) as client:

            def processors():
                return sum(client.run(time.process_time).values())

            sweep(values[:100], 50)
            used, start = -processors(), time.perf_counter()
            sweep(values, block)
            clock, used = time.perf_counter() - start, used + processors()
            print(
                f"{processes} process(es): {clock:.1f} s; {used:.1f} s of processors, {1e3 * used / limits:.3f} ms a limit; "
                f"share of a processor each: {used / clock / processes:.2f}"
            )
