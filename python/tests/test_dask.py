"""Sweeps on a cluster of two processes: the same bits, a killed worker loses nothing."""

import os
import signal
import time

import numpy as np
import pytest

import courant_stability as courant

pytest.importorskip("dask.array")
pytest.importorskip("distributed")

import courant_stability.dask  # noqa: E402

DIFFUSION = "u[n+1,j] = u[n,j] - C/2*(u[n,j+1] - u[n,j-1]) + r*(u[n,j+1] - 2*u[n,j] + u[n,j-1])"


@pytest.fixture(scope="module")
def cluster():
    from distributed import Client, LocalCluster

    with (
        LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        yield client


def same(one, other):
    return one.tobytes() == other.tobytes()


def test_bits_are_those_of_one_process(cluster):
    r, c = np.linspace(0.01, 0.6, 31), np.linspace(0.01, 1.2, 29)
    scheme = courant.Scheme(DIFFUSION)
    here = courant.stability_map(scheme, ("r", r), ("C", c))
    for chunks in [(7, -1), (31, 10), (5, 3)]:
        there = courant.dask.stability_map(scheme, ("r", r), ("C", c), chunks=chunks).compute()
        for name in ("largest", "lowest", "stable", "limits"):
            assert same(getattr(here, name), getattr(there, name)), (name, chunks)
    sph = courant.scheme("godunov-sph", kernel="gaussian", ratio=1)
    ratios = np.linspace(1, 4, 13)
    table = courant.dask.limits_table(sph, ratio=ratios, chunks=4)
    assert table.dtype == courant.limit_dtype(1)
    assert same(table.compute(), courant.limits_table(sph, ratio=ratios, exact=False).data)


def test_parameters_are_broadcast(cluster):
    scheme = courant.Scheme("u[n+1,j] = u[n,j] - C*a*(u[n,j] - u[n,j-1]) - C*b*(u[n,j] - u[n,j-2])")
    a, b = np.linspace(0.1, 1, 6)[:, None], np.linspace(0, 0.5, 5)
    there = courant.dask.limits_table(scheme, a=a, b=b, chunks=3).compute()
    assert there.shape == (6, 5)
    assert same(there, courant.limits_table(scheme, a=a, b=b, exact=False).data)


def test_a_killed_worker_loses_nothing(cluster):
    scheme = courant.scheme("lax-wendroff-sph", kernel="cubic-spline", ratio=1)
    ratios = np.linspace(1, 10, 2400)
    table = courant.dask.limits_table(scheme, ratio=ratios, chunks=100)
    workers = list(cluster.run(os.getpid).values())
    assert len(workers) == 2
    running = cluster.compute(table)
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline and running.status == "pending":
        states = cluster.run_on_scheduler(lambda dask_scheduler: [t.state for t in dask_scheduler.tasks.values()])
        if states.count("memory") >= 4:
            break
        time.sleep(0.01)
    assert running.status == "pending", "it must be killed in the middle"
    os.kill(workers[0], signal.SIGKILL)
    there = running.result(timeout=300)
    assert workers[0] not in cluster.run(os.getpid).values()
    assert same(there, courant.limits_table(scheme, ratio=ratios, exact=False).data)
