#!/usr/bin/env python3
"""Prints the scenario of the demo made ten minutes long: what is held is put down and the next thing is wanted.

    ten_minutes.py assets/scenarios/pick_and_place.toml > ten_minutes.toml
"""

import re
import sys
from pathlib import Path

FRAMES = 600  # of one second
DRIVES = 200  # a grasp and a release take three frames

demo = Path(sys.argv[1]).resolve()
text = re.sub(r'^(replicode|model) = "(.+\.\w+)"', lambda match: f'{match[1]} = "{demo.parent / match[2]}"',
              demo.read_text(), flags=re.MULTILINE)
text, found = re.subn(r"^(sampling_period_ms = 1000)$", rf"\1\nmin_frames = {FRAMES}\nmax_frames = {FRAMES}", text,
                      flags=re.MULTILINE)
assert found == 1, "the demo's frames are not one second long any more"
for i in range(DRIVES):
    thing = ("s1", "s2", "cyl")[i % 3]
    for wish in ("nothing", thing):
        text += f'\n[[drives]]\ntitle = "hold {wish}"\nmodel = "drive_hold_{wish}"\n'
print(text)
