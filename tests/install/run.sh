#!/usr/bin/env bash
# run.sh BUILD: installs a build into a temporary folder, builds the examples of docs/examples/library against that tree, and runs
# them and the program outside of the repository. The same face in C, C++ and Python (skipped without numpy) has the same nose.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build="$(realpath "$1")"
source_folder="$PWD"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
prefix="$work/prefix"
fail() { printf 'install: %s\n' "$*" >&2; exit 1; }

cmake --install "$build" --prefix "$prefix" >"$work/install.log" || { tail -5 "$work/install.log"; fail "cmake --install failed"; }
libraries="$(dirname "$(find "$prefix" -name libdaumier.so)")"
cp -r docs/examples/library docs/examples/drawings/girl.svg "$work"
cd "$work"

unexpected="$(nm -D --defined-only "$libraries/libdaumier.so" | awk '$2 != "A" && $3 !~ /^daumier_[a-z_]+@@DAUMIER_0$/ { print $3 }')"
[ -z "$unexpected" ] || fail "libdaumier.so shows other symbols than those of daumier.h: $unexpected"
declared="$(grep -o '\bdaumier_[a-z_]*(' "$prefix/include/daumier.h" | tr -d '(' | sort -u)"
defined="$(nm -D --defined-only "$libraries/libdaumier.so" | sed -n 's/.* T \(daumier_[a-z_]*\)@.*/\1/p' | sort)"
[ "$declared" = "$defined" ] || fail "daumier.h declares other functions than libdaumier.so has"

cc -std=c99 -pedantic -Wall -Wextra -Werror library/draw_a_face.c -I"$prefix/include" -L"$libraries" -ldaumier -o draw_a_face
in_c="$(LD_LIBRARY_PATH="$libraries" ./draw_a_face girl.svg c.glb)"
echo "C: $in_c"

cmake -S library -B examples -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release >configure.log 2>&1 || { tail -20 configure.log; fail "find_package(Daumier) failed"; }
cmake --build examples >build.log 2>&1 || { tail -20 build.log; fail "the examples do not build"; }
in_cpp="$(DAUMIER_WEIGHTS="$prefix/share/daumier/weights" examples/draw_a_face_cpp girl.svg cpp.glb)"
echo "C++: $in_cpp"
[ "$(LD_LIBRARY_PATH="$libraries" examples/draw_a_face_c girl.svg again.glb)" = "$in_c" ] || fail "the C example of CMake differs"
cmp c.glb again.glb
[ "$in_cpp" = "$in_c" ] || fail "C and C++ differ"

python=""
for candidate in python3 /usr/bin/python3; do
  [ -n "$python" ] || ! "$candidate" -c 'import numpy' 2>/dev/null || python="$candidate"
done
if [ -n "$python" ]; then
  in_python="$(LD_LIBRARY_PATH="$libraries" "$python" library/draw_a_face.py girl.svg python.glb)"
  echo "Python: $in_python"
  [ "$in_python" = "$in_c" ] || fail "C and Python differ"
  [ -s python.glb ] || fail "python.glb is missing"
else
  echo "skipped install: the Python example, without python3 and numpy"
fi

"$prefix/bin/daumier" predict girl.svg --out predicted >predict.log 2>&1 || { cat predict.log; fail "the installed program predicts nothing"; }
grep -q "$prefix/share/daumier/weights" predict.log || fail "the installed program uses other weights"
[ -s predicted/girl.obj ] || fail "predicted/girl.obj is missing"
if [ -e "$libraries/daumier/libdaumier_training.so" ]; then
  "$prefix/bin/daumier" info --json 2>info.log | grep -q '"libtorch"' || { cat info.log; fail "the installed program does not load the training library"; }
fi
! grep -rlF --include='*.cmake' --include='*.pc' --include='*.h' "$source_folder" "$prefix" || fail "the files above name the source folder"
