#!/usr/bin/env bash
# Drawings -> heads by the shipped weights, into runs/try. Finds `daumier` on the PATH; `./dev try` puts it there.
set -euo pipefail
out=runs/try
began=$(date +%s)

daumier predict docs/examples/drawings/man.svg docs/examples/drawings/girl.svg docs/examples/drawings/quickdraw.ndjson --out "$out"

cat <<DONE

The predictions took $(($(date +%s) - began)) s. Look at
  $out/man.png     the drawing with the head's curves, and the head; also girl, quickdraw (docs/examples/drawings)
  $out/man.obj     the head as a mesh
Now a drawing of your own, SVG or a picture: PATH=$PWD/build/try/bin:\$PATH daumier predict drawing.jpg --out predicted
DONE
