"""The reports: comparing, judging, writing, the command, the plug-in, and the committed tables."""

import time

BEGUN = time.time()  # s: a file of code that is newer than this is not the code that runs
