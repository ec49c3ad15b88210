"""What all tests need."""

import signal

import pytest


@pytest.fixture(autouse=True)
def ctrl_c():
    """Ctrl-C is heard, also where the tests run in the background of a script, which leaves it ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)
