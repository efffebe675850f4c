#!/usr/bin/env bash
# Installs what holdfast needs from the packages of Debian 12: only what is missing, nothing when all is there.
#   tools/install_dependencies.sh           to build and run
#   tools/install_dependencies.sh --test    and what tests, examples and benchmarks need
#   tools/install_dependencies.sh --dev     and what lint and the Clang build need
#   tools/install_dependencies.sh --python  to build, run and test, with the Python package
#   tools/install_dependencies.sh --viewer  to build the page that shows results; --viewer-test also to test it in a browser
#   tools/install_dependencies.sh --viewer-engine  to build the engine that the page runs
#   tools/install_dependencies.sh --docs    to make a site of the documentation
set -euo pipefail

packages=(
  build-essential    # g++ 12, the compiler; make, the front door
  cmake              # configures the build
  ninja-build        # runs the build
  pkg-config         # finds the libraries that bring no CMake files
  libbullet-dev      # Bullet, the rigid-body engine behind the plug-ins, in single and double precision
  ocl-icd-opencl-dev # OpenCL's headers and loader, for Bullet's OpenCL pipeline (in libbullet-dev)
  libtbb-dev         # oneTBB, spreads worlds over cores
  libeigen3-dev      # Eigen, vectors and rotations
  libhwy-dev         # Highway, SIMD of the native engine, chosen for the CPU at run time
  libhdf5-dev        # HDF5, the format of the results file
  libfmt-dev         # fmt, messages and text files (GCC 12 has no <format>)
  libinih-dev        # inih, reads config.ini
  libcli11-dev       # CLI11, the command line
  nlohmann-json3-dev # JSON output
  libmicrohttpd-dev  # serves results to the browser of this machine
  libssl-dev         # SHA-256 of the inputs
  libdeflate-dev     # compresses chunks of the results file on the workers
  zlib1g-dev         # compresses chunks that are nearly empty
)
test_packages=(
  catch2             # Catch2 2.13, the tests
  pocl-opencl-icd    # PoCL, the processor as an OpenCL device where there is no GPU
  hdf5-tools         # h5dump and h5ls, to look into a results file; tests read with them
  libopenmpi-dev     # MPI, for holdfast-mpi, which is built where this is
  openmpi-bin        # mpirun
  python3            # the checks in tools/, benchmarks and examples
  python3-h5py       # the tests read results files as a user would
  python3-scipy      # the linear programs that tests compare the proof of rest with
  python3-pandas     # tables in examples and benchmarks
  python3-openpyxl   # a spreadsheet, which the test of `Load.read` writes and reads
  python3-jsonschema # the schema of loads in JSON, against what the program writes and refuses
  python3-matplotlib # plots in examples and benchmarks
  weasyprint         # PDF of `holdfast report`
)
dev_packages=(
  clang              # the second compiler
  clang-format       # the one format of the sources
  clang-tidy         # names and likely bugs
  libomp-dev         # OpenMP for Clang
  ccache             # makes a second build of the same code quick
  libclang-rt-14-dev # sanitizers for Clang
)
python_packages=(
  pybind11-dev       # pybind11, the compiled part of the Python package
  python3-dev        # headers of Python
  python3-numpy      # arrays in and out
  python3-pip        # pip install . --no-build-isolation
  python3-pybind11   # pybind11 as pip looks for it
  python3-setuptools # the build that pip starts
  python3-venv       # the environment that pip installs into
  python3-wheel      # what it makes
  mypy               # checks types and the stub
  python3-distributed # Dask, worker processes on many machines, in an example and its test
  python3-deap       # DEAP, evolutionary algorithms, in an example and its test
)
# Node comes with npm in most other distributions of it; whatever is there is used.
viewer_packages=()
command -v node > /dev/null || viewer_packages+=(nodejs) # bundles the page's sources
command -v npm > /dev/null || viewer_packages+=(npm)     # brings the packages of viewer/package-lock.json
viewer_engine_packages=(
  emscripten         # compiles the native engine to WebAssembly
  node-acorn         # emscripten's own reader of JavaScript
  libfast-float-dev  # numbers from text, which emscripten's C++ library lacks
  cmake ninja-build libeigen3-dev libhwy-dev nlohmann-json3-dev
)
viewer_test_packages=(
  chromium           # the browser that the tests of the page drive
  firefox-esr        # a second one, which one journey is tested in
  xvfb               # a display for it, without which it has no WebGL
  webp               # makes the film of README out of pictures
)
docs_packages=(
  mkdocs             # makes a site of docs/, with a search
)

case "${1-}" in
  '') ;;
  --test) packages+=("${test_packages[@]}") ;;
  --dev) packages+=("${test_packages[@]}" "${dev_packages[@]}") ;;
  --python) packages+=("${test_packages[@]}" "${python_packages[@]}") ;;
  --viewer) packages=(${viewer_packages[@]+"${viewer_packages[@]}"}) ;;
  --viewer-engine) packages=("${viewer_engine_packages[@]}" ${viewer_packages[@]+"${viewer_packages[@]}"}) ;;
  --viewer-test) packages+=("${test_packages[@]}" ${viewer_packages[@]+"${viewer_packages[@]}"} "${viewer_test_packages[@]}") ;;
  --docs) packages=("${docs_packages[@]}") ;;
  -h | --help) sed -n '2,9s/^# //p' "$0"; exit 0 ;;
  *) echo "$0: unknown option: $1; accepted: --test, --dev, --python, --viewer, --viewer-engine, --viewer-test, --docs, --help" >&2; exit 2 ;;
esac

if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
  echo "This is no Debian system: install these packages' equivalents, then run make with INSTALL=true:" >&2
  echo "  ${packages[*]}" >&2
  exit 1
fi

if ((${#packages[@]} == 0)); then
  echo "Dependencies: nothing to install"
  exit 0
fi

# dpkg-query fails when a package is unknown; what it does know it prints all the same.
installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${packages[@]}" 2> /dev/null | sed -n 's/^installed //p' || true)
missing=()
for package in "${packages[@]}"; do
  grep -qxF -- "$package" <<< "$installed" || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  echo "Dependencies: nothing to install"
  exit 0
fi

if ((EUID != 0)) && ! command -v sudo > /dev/null; then
  echo "These packages are missing, and installing them takes root or sudo:" >&2
  echo "  ${missing[*]}" >&2
  exit 1
fi

echo "Dependencies: installing ${missing[*]}"
apt_get=$(dirname "$0")/apt_get.sh
"$apt_get" update
"$apt_get" install -y --no-install-recommends "${missing[@]}"
