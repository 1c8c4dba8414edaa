#!/usr/bin/env bash
# Makes the virtual environment $1 from the first CPython >= 3.10 that can: $PYTHON, python3, python3.x.
set -euo pipefail

venv=$1
tried=()

usable() { # a CPython >= 3.10 that starts at all (a launcher may stand for a version that is not there)
  "$1" -c 'import sys; sys.exit(sys.implementation.name != "cpython" or sys.version_info < (3, 10))' \
    >/dev/null 2>&1
}

make_with() { # some systems ship Python without ensurepip: then the system's own pip fills the venv
  rm -rf "$venv"
  "$1" -m venv "$venv" >/dev/null 2>&1 && return
  rm -rf "$venv"
  "$1" -m virtualenv --quiet "$venv" >/dev/null 2>&1 && return
  rm -rf "$venv"
  "$1" -m venv --without-pip "$venv" >/dev/null 2>&1 &&
    "$1" -m pip --quiet --python "$venv/bin/python" install pip >/dev/null 2>&1
}

for python in ${PYTHON:-} python3 python python3.13 python3.12 python3.11 python3.10 python3.14; do
  command -v "$python" >/dev/null 2>&1 || continue
  usable "$python" || continue
  tried+=("$python")
  if make_with "$python"; then
    "$venv/bin/python" -c 'import sys; print("virtual environment: Python", sys.version.split()[0])'
    exit 0
  fi
done

rm -rf "$venv"
if [ ${#tried[@]} -eq 0 ]; then
  echo "No CPython >= 3.10 found; set PYTHON=/path/to/python3" >&2
else
  echo "None of ${tried[*]} can make a virtual environment; install its venv module" \
    "(python3-venv on Debian) or virtualenv, or set PYTHON=/path/to/another" >&2
fi
exit 1
