#!/usr/bin/env bash
# The main job on the default source: faces -> sketches -> train -> eval -> ONNX -> pictures, into runs/demo and data/demo;
# then, with the shipped weights, three drawings -> heads and a portrait -> an animatable head.
# Finds `daumier` on the PATH; `./dev demo` puts it there. --fresh starts from nothing.
set -euo pipefail
data=data/demo run=runs/demo
[ "${1:-}" = --fresh ] && rm -rf "$data" "$run"
began=$(date +%s)

step() { printf '\n\033[1m%s\033[0m\n' "$*" >&2; "$@"; }

step daumier dataset faces --config configs/faces/demo.toml --out "$data/faces"
step daumier dataset sketches --config configs/sketches/frontal.toml --out "$data/sketches" faces="$data/faces"
step daumier dataset gallery "$data/faces" "$data/sketches" --out "$data/gallery"
resume=()
[ -f "$run/manifest.json" ] && resume=(--resume)
step daumier train configs/sketch/demo.toml --out "$run" "${resume[@]}" data.faces="$data/faces" data.sketches="$data/sketches"
step daumier eval "$run"
step daumier export "$run" --out "$run/export"
step daumier predict docs/examples/drawings/man.svg docs/examples/drawings/girl.svg \
  docs/examples/drawings/quickdraw.ndjson --out "$run/drawings"
step daumier avatar docs/examples/portraits/woman.jpg --out "$run/woman.glb" --stages "$run/woman"

cat <<DONE

The demo took $(($(date +%s) - began)) s. Look at
  $run/report/index.html       errors, sheets, heat maps
  $data/gallery/               the faces and sketches it learned from
  $run/drawings/man.png        a drawing and its head; also girl, quickdraw (docs/examples/drawings)
  $run/woman.glb               a portrait as a head with 52 expressions; $run/woman.png shows it, $run/woman/ its stages
  $run/export/model.onnx       the network, with parity.json and model_card.md
DONE
