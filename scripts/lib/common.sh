# Sourced by the other scripts: where the repository is, how Open MPI shall behave, how many jobs fit, which Python to use.
# shellcheck shell=bash

# shellcheck disable=SC2034  # used by the scripts that source this
repository="$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)"

# A value that the caller has set stays.
if ((EUID == 0)); then
  export OMPI_ALLOW_RUN_AS_ROOT="${OMPI_ALLOW_RUN_AS_ROOT:-1}"
  export OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="${OMPI_ALLOW_RUN_AS_ROOT_CONFIRM:-1}"
fi
# The tests use up to four ranks, also where there are fewer cores.
export OMPI_MCA_rmaps_base_oversubscribe="${OMPI_MCA_rmaps_base_oversubscribe:-1}"
# Ranks that wait give way, which matters where there are more of them than cores.
export OMPI_MCA_mpi_yield_when_idle="${OMPI_MCA_mpi_yield_when_idle:-1}"
# Containers commonly forbid one process to read another's memory; Open MPI then warns at every start.
export OMPI_MCA_btl_vader_single_copy_mechanism="${OMPI_MCA_btl_vader_single_copy_mechanism:-none}"

# Prints the number of compile jobs: one a core, as far as 1.5 GB of free memory each allow. PLIANT_JOBS overrides it.
job_count() {
  if [[ -n "${PLIANT_JOBS:-}" ]]; then
    echo "$PLIANT_JOBS"
    return
  fi
  local cores fit
  cores="$(nproc)"
  fit="$(awk '/^MemAvailable:/ {print int($2 / 1500000)}' /proc/meminfo 2>/dev/null || true)"
  fit="${fit:-$cores}"
  ((fit < 1)) && fit=1
  echo $((fit < cores ? fit : cores))
}

# Prints a Python that has what the figures need. The first in PATH may be one that Debian's modules are not installed for.
find_python() {
  local candidate
  for candidate in "${PLIANT_PYTHON:-}" python3 /usr/bin/python3; do
    [[ -n "$candidate" ]] || continue
    if "$candidate" -c 'import numpy, matplotlib, h5py' >/dev/null 2>&1; then
      command -v "$candidate"
      return
    fi
  done
  echo "No Python with numpy, matplotlib and h5py was found; run scripts/setup, or name one in PLIANT_PYTHON." >&2
  return 1
}

# Configures and builds the release preset. Arguments: further arguments of the build, such as --target pliant.
build_release() {
  (cd -- "$repository" && cmake --preset release && cmake --build --preset release -j "$(job_count)" "$@")
}
