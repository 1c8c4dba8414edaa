#!/usr/bin/env bash
# Tamaas 2.9.0, KatoSaturated: a ball on a flat whose surface bears 450 MPa. In pascals and metres the solver does
# not come to an end within a minute, whatever `max_iter`. The same contact with pressures over the contact modulus
# and lengths over the width takes a second, and is right (500 cells at the limit).
# pyfret solves it in SI units: Body(hardness=...), tests/test_hardness.py has these numbers.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check tamaas==2.9.0 numpy==2.2.6
cat > "$folder/ball.py" <<'PYTHON'
import sys

import numpy as np
import tamaas as tm

tm.set_log_level(tm.LogLevel.error)
R, E, n, pitch, H = 8e-3, 210e9 / (2 * (1 - 0.3**2)), 64, 4e-6, 4.5e8
width = n * pitch
W = 4 * E * (0.25 * width) ** 3 / (3 * R)
x = (np.arange(n) - (n - 1) / 2) * pitch
ball = (x[:, None] ** 2 + x[None, :] ** 2) / (2 * R)
# Units of pressure [Pa] and of length [m].
pressure, length = (1.0, 1.0) if sys.argv[1] == "SI" else (E, width)
side = width / length
model = tm.ModelFactory.createModel(tm.model_type.basic_2d, [side, side], [n, n])
model.E, model.nu = E / pressure, 0.0
tm.ModelFactory.registerNonPeriodic(model, "dcfft")
solver = tm.KatoSaturated(model, -ball / length, 1e-8, H / pressure)
solver.setIntegralOperator("dcfft")
solver.max_iter = 200
solver.dump_freq = 10**6
solver.solve(W / width**2 / pressure)
p = np.array(model.traction) * pressure
print(f"{np.count_nonzero(p > 0)} cells in contact, {np.count_nonzero(p >= H * (1 - 1e-9))} of them at {H:g} Pa")
PYTHON
python="$folder/venv/bin/python"
echo "Tamaas $("$python" -c 'import tamaas; print(tamaas.__version__)'), E* = 115 GPa, R = 8 mm, 64 x 64 cells of 4 um, limit 450 MPa"
over=$("$python" "$folder/ball.py" over)
echo "pressures over E*, lengths over the width: $over"
status=0
si=$(timeout 60 "$python" "$folder/ball.py" SI) || status=$?
if [ "$status" = 124 ]; then
    echo "pascals and metres, max_iter = 200: no end within 60 s"
else
    echo "pascals and metres: ${si:-nothing}, exit status $status"
fi
echo "right: 840 cells in contact, 500 of them at 4.5e+08 Pa, in any units"
[ "$over" = "840 cells in contact, 500 of them at 4.5e+08 Pa" ] && [ "$status" = 124 ] || {
    echo "Tamaas behaves otherwise now"
    exit 1
}
