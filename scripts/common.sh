# SPDX-License-Identifier: GPL-3.0-or-later
# Shared by setup, demo and test: where things are, stages with their times, readable failures.
# A script sets `stage_log_dir` (or leaves it) and calls `stage "what" command...`.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
system_python=/usr/bin/python3   # Debian's own: Blender 3.4.1 runs on it, and the bpy wheels need the same 3.11
build_dir=$root/build/release
stage_log_dir=$root/build/logs
# Debian's Blender looks for its Python by the PATH: pyenv, conda or an active venv must not come first.
export PATH=/usr/sbin:/usr/bin:/sbin:/bin:$PATH

say() { printf '%s\n' "$*"; }
die() { printf 'cardioid: %s\n' "$*" >&2; exit 1; }

# seconds since $1 (an EPOCHREALTIME value), one decimal
elapsed_since() { awk -v a="$1" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f", b - a }'; }

# stage NAME COMMAND...: runs the command with its output in a log; on failure shows the end of the log and stops.
stage() {
    local title=$1 start=$EPOCHREALTIME log code=0
    shift
    mkdir -p "$stage_log_dir"
    log=$stage_log_dir/${title//[^A-Za-z0-9]/_}.log
    printf '%-34s' "$title ..."
    set +e   # a subshell of its own, so that a function stops at its first error as a script does
    (set -e; "$@") >"$log" 2>&1 </dev/null
    code=$?
    set -e
    if ((code != 0)); then
        say "FAILED after $(elapsed_since "$start") s"
        stage_excerpt "$log" >&2
        die "'$title' failed (exit code $code). The whole log: $log"
    fi
    say "$(elapsed_since "$start") s"
}

# The lines of a log that say what went wrong, or its end.
stage_excerpt() {
    local log=$1 lines
    lines=$(grep -nEi '(^|[^a-z_])(error|fatal|failed)([^a-z_]|$)' "$log" | head -n 12 || true)
    say "--- $log"
    if [[ -n $lines ]]; then say "$lines"; else tail -n 15 "$log"; fi
    say "---"
}

# Configures and builds everything in Release.
configure_release() {
    cmake -S "$root" -B "$build_dir" -G Ninja -DCMAKE_BUILD_TYPE=Release \
        -DPython_EXECUTABLE=$system_python -DPYTHON_EXECUTABLE=$system_python "$@"
}
# Paths inside the checkout are hashed as relative: a second clone finds the objects of the first in the cache.
build_release() { CCACHE_BASEDIR=$root cmake --build "$build_dir" --parallel "$(nproc)"; }
