#!/bin/bash
# wheel_test.sh SOURCE FOLDER PROGRAM: builds the wheel of the Python module in a fresh virtual
# environment, installs it, and runs the module's tests, its types and its notebook with it. Needs
# packages of PyPI.
set -eu
source=$(realpath "$1")
program=$(realpath "$3")
rm -rf "$2"
mkdir -p "$2"
cd "$2"

python3 -m venv environment
. environment/bin/activate
export PIP_DISABLE_PIP_VERSION_CHECK=1 CMAKE_BUILD_PARALLEL_LEVEL=2
pip wheel --quiet --no-deps --wheel-dir . "$source/libtransillum/python"
wheel=$(echo transillum-*.whl)
pip install --quiet "$wheel[pyvista]" mypy scipy-stubs nbconvert ipykernel matplotlib
ls -l "$wheel"

core=$(python -c 'import transillum._core as core; print(core.__file__)')
if ldd "$core" | grep -iE 'vtk|cairo|not found'; then
  echo "the wheel needs what it must not, or lacks a library"
  exit 1
fi
TRANSILLUM_PROGRAM=$program python -m unittest discover -s "$source/tests/python"
mypy --strict -p transillum
python -m mypy.stubtest transillum --allowlist "$source/tests/python/stubtest_exceptions.txt"
for notebook in "$source"/libtransillum/python/notebooks/*.ipynb; do
  jupyter nbconvert --execute --to html --output-dir . "$notebook"
done
