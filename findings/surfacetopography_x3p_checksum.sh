#!/usr/bin/env bash
# SurfaceTopography 1.27.1 writes X3P files whose md5checksum.hex holds the checksum of the heights.
#
# ISO 25178-72, Record4/ChecksumFile: the file has the MD5 checksum of main.xml. Readers that verify it
# (x3pio 2.0.0) refuse such a file as damaged. pyfret reads it with a warning: `read_x3p` in
# python/pyfret/scene/standard_maps.py.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet SurfaceTopography==1.27.1 x3pio==2.0.0
cd "$folder"
venv/bin/python - <<'PYTHON'
import hashlib
import sys
import warnings
import zipfile

warnings.simplefilter("ignore")

import numpy as np
import x3pio
from SurfaceTopography import Topography

heights = 1e-6 * np.add.outer(np.arange(5.0), 10.0 * np.arange(3))
Topography(heights, (1e-5, 3e-6), unit="m").to_x3p("map.x3p")
with zipfile.ZipFile("map.x3p") as archive:
    stored = archive.read("md5checksum.hex").decode().split()
    sums = {n: hashlib.md5(archive.read(n)).hexdigest() for n in archive.namelist()}
print("SurfaceTopography 1.27.1 wrote 5 x 3 heights")
print("md5checksum.hex:", *stored)
print("main.xml:       ", sums["main.xml"])
print("data.bin:       ", sums["bindata/data.bin"])
try:
    x3pio.read("map.x3p")
    answer = "read"
except x3pio.X3pChecksumError as error:
    answer = f"refused: {error}"
print("x3pio 2.0.0:    ", answer)
print("right:           the checksum of main.xml")
same = stored[0].lower() == sums["bindata/data.bin"] and answer.startswith("refused")
print("unchanged" if same else "CHANGED: SurfaceTopography or x3pio behaves otherwise now")
sys.exit(not same)
PYTHON
