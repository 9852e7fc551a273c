"""What the process imports of which the crew's and the jobs' processes are copies: everything that a request needs.

It computes one of everything, so that the kernels are in memory. A stop of the service is not for it to follow: its
copies are to finish first. It ends by itself when the service does.
"""

import gc
import importlib
import signal

from app.kinematics.warm import warm_up

signal.signal(signal.SIGTERM, signal.SIG_IGN)
for module in ("app.main", "app.plots.profiles", "sympy"):
    importlib.import_module(module)
warm_up()
# The copies share what is here for as long as nobody writes to it, and the collector of garbage would.
gc.collect()
gc.freeze()
