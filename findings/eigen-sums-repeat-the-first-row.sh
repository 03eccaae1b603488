#!/usr/bin/env bash
# Eigen 3.4.0 (Debian 12: libeigen3-dev 3.4.0-4): sums over an indexed column of a row-major matrix.
#
# Expected: m(rows, column).sum() adds the entries that the same expression gives when it is read one by one or copied to a vector.
# Behaviour: of a row-major matrix with a fixed number of columns and a std::vector of rows, sum() and mean() add the first of the
#   chosen entries again and again. Of a column-major matrix, and of a copy of the expression, they are right. Nothing is reported;
#   the optimisation level makes no difference.
# Output seen (rows 1, 4, 5 of column 1 hold 4, 13, 16):
#   row-major 12, copied 33, column-major 33
# Exit: 0 as described, 1 changed, 2 no packages.
set -euo pipefail
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get download -qq libeigen3-dev=3.4.0-4 2>/dev/null ||
  { echo "the pinned package of Debian 12 cannot be had here; this system has libeigen3-dev $(dpkg-query -W -f '${Version}' libeigen3-dev 2>/dev/null || echo 'not at all')"; exit 2; }
dpkg -x libeigen3-dev*.deb .

cat >main.cpp <<'CPP'
#include <Eigen/Core>

#include <cstdio>
#include <vector>

int main() {
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> points(6, 3);
  for (int i = 0; i < points.size(); ++i) points.data()[i] = i;
  const Eigen::Matrix<double, Eigen::Dynamic, 3> by_columns = points;
  const std::vector<int> rows = {1, 4, 5};
  const Eigen::VectorXd copied = points(rows, 1);
  std::printf("row-major %g, copied %g, column-major %g\n", points(rows, 1).sum(), copied.sum(), by_columns(rows, 1).sum());
}
CPP
g++ -std=c++17 -O2 -isystem usr/include/eigen3 main.cpp -o main
seen="$(./main)"
echo "$seen"
[ "$seen" = "row-major 12, copied 33, column-major 33" ] || { echo "changed"; exit 1; }
