#!/usr/bin/env bash
# Makes the shipped weights from nothing: face-ict, landmarks, portrait, parser, sketch-ict, gestures.
#   tools/make_weights.sh ICT OUT [WORK]
# ICT: a checkout of ICT-FaceKit or its tar archive. OUT: folder of the weights. WORK: folder of data and runs, about
# 3 GB (default: runs/weights). Finished steps are skipped and a stopped step resumes: run the same command again.
# Finds `daumier` on the PATH. In the environment, if other than below:
#   PERSONS IMAGES LANDMARK_EPOCHS PORTRAIT_EPOCHS            sizes of the data of portraits and lengths of the trainings
#   SKETCH_PERSONS PARSER_EPOCHS SKETCH_EPOCHS                 the same of drawings
#   GESTURE_HANDS GESTURE_EPOCHS                               the same of gestures
#   ONLY        portraits, drawings or gestures: these weights alone, after face-ict
#   PICTURES    pictures with landmark files of the same name, on which errors are measured as well
#   NEGATIVES   pictures without a face
#   NOTES       folder of NAME.md with known failures, copied into the card of the weights NAME
# Every command is in the manifest and the card of the weights that it leads to, with its seconds; the seed is 1.
set -euo pipefail
if [ $# -lt 2 ] || [ $# -gt 3 ]; then
  sed -n '2,15s/^# \{0,1\}//p' "$0" >&2
  exit 2
fi
ict=$1 out=$2 work=${3:-runs/weights}
persons=${PERSONS:-150} images=${IMAGES:-4800}
landmark_epochs=${LANDMARK_EPOCHS:-18} portrait_epochs=${PORTRAIT_EPOCHS:-26}
sketch_persons=${SKETCH_PERSONS:-200} parser_epochs=${PARSER_EPOCHS:-14} sketch_epochs=${SKETCH_EPOCHS:-30}
gesture_hands=${GESTURE_HANDS:-400} gesture_epochs=${GESTURE_EPOCHS:-5}
only=${ONLY:-portraits drawings gestures}
configs=$(cd "$(dirname "$0")/../configs" && pwd)
[ -e "$ict" ] || { echo "$ict does not exist (expected a checkout of ICT-FaceKit or its tar archive)" >&2; exit 1; }
mkdir -p "$work/steps" "$work/runs" "$out"

# A command as it is recorded: without folders of this machine, and as if it had not been stopped.
recorded() {
  local text="$*"
  text=${text//"$configs"/configs} text=${text//"$ict"/ICT} text=${text//"$work"/WORK} text=${text//"$out"/weights}
  [ -z "${PICTURES:-}" ] || text=${text//"$PICTURES"/PICTURES}
  [ -z "${NEGATIVES:-}" ] || text=${text//"$NEGATIVES"/NEGATIVES}
  printf '%s' "${text// --resume/}" | sed 's/\\/\\\\/g; s/"/\\"/g'
}

# step NAME "EARLIER..." FILE COMMAND...: runs a command whose last file is FILE, and records it in WORK/steps/NAME.json.
# Skips it if the same command is recorded and no earlier step has run since.
step() {
  local name=$1 earlier=$2 file=$3 record="$work/steps/$1.json" text began other is_done=1
  shift 3
  text=$(recorded "$@")
  { [ -f "$file" ] && [ -f "$record" ] && grep -qF "{\"command\": \"$text\", " "$record"; } || is_done=0
  for other in $earlier; do
    [ ! "$work/steps/$other.json" -nt "$record" ] || is_done=0
  done
  if [ $is_done = 1 ]; then
    echo "$name: finished, skipped" >&2
    return
  fi
  printf '\n\033[1m%s\033[0m  (seed 1)\n' "$text" >&2
  began=$(date +%s)
  "$@"
  printf '{"command": "%s", "seconds": %d}\n' "$text" $(($(date +%s) - began)) > "$record.tmp"
  mv "$record.tmp" "$record"
  echo "$name: $(($(date +%s) - began)) s" >&2
}

# train NAME "DATA..." CONFIG OPTION...: the run WORK/runs/NAME. Its graph is the last file that a training writes.
train() {
  local name=$1 data=$2 config=$3 resume=()
  shift 3
  [ ! -f "$work/runs/$name/manifest.json" ] || resume=(--resume)
  step "train_$name" "$data" "$work/runs/$name/best/model.onnx" \
    daumier train "$config" --out "$work/runs/$name" "${resume[@]}" "$@"
}

# ship NAME STEP...: the weights NAME of its run, made by these steps.
ship() {
  local name=$1 separator='[' other notes=()
  shift
  for other in "$@"; do
    printf '%s' "$separator"
    cat "$work/steps/$other.json"
    separator=','
  done > "$work/steps/$name.recipe"
  echo ']' >> "$work/steps/$name.recipe"
  [ ! -f "${NOTES:-}/$name.md" ] || notes=(--notes "$NOTES/$name.md")
  step "ship_$name" "face-ict $*" "$out/$name/manifest.json" \
    daumier export "$work/runs/$name" --weights --out "$out/$name" --recipe "$work/steps/$name.recipe" "${notes[@]}"
}

pictures=() negatives=()
[ -z "${PICTURES:-}" ] || pictures=("pictures=$PICTURES")
[ -z "${NEGATIVES:-}" ] || negatives=("negatives=$NEGATIVES")

step face-ict "" "$out/face-ict/manifest.json" \
  daumier dataset model --out "$out/face-ict" source.name=ict "source.path=$ict"
make_portraits() {
  step faces "" "$work/faces/manifest.json" daumier dataset faces --config "$configs/faces/caricature.toml" \
    --out "$work/faces" "source.path=$ict" "num_persons=$persons" 'expressions=["neutral"]'
  step portraits faces "$work/portraits/manifest.json" daumier dataset portraits \
    --config "$configs/portraits/small.toml" --out "$work/portraits" "faces=$work/faces" "source.path=$ict" \
    "num_images=$images"

  train landmarks "faces portraits" "$configs/portrait/landmarks.toml" "data.portraits=$work/portraits" "epochs=$landmark_epochs" \
    validate_every=6 precision=auto
  step eval_landmarks train_landmarks "$work/runs/landmarks/report/manifest.json" \
    daumier eval "$work/runs/landmarks" "${pictures[@]}" "${negatives[@]}"
  ship landmarks faces portraits train_landmarks eval_landmarks

  train portrait "faces portraits" "$configs/portrait/cpu.toml" "data.faces=$work/faces" "data.portraits=$work/portraits" \
    "source.path=$ict" "epochs=$portrait_epochs" precision=auto
  step eval_portrait train_portrait "$work/runs/portrait/report/manifest.json" \
    daumier eval "$work/runs/portrait" "${pictures[@]}"
  ship portrait faces portraits train_portrait eval_portrait
}

make_drawings() {
  step drawn_faces "" "$work/drawn_faces/manifest.json" daumier dataset faces \
    --config "$configs/faces/caricature.toml" --out "$work/drawn_faces" "source.path=$ict" \
    "num_persons=$sketch_persons"
  step sketches drawn_faces "$work/sketches/manifest.json" daumier dataset sketches \
    --config "$configs/sketches/styles.toml" --out "$work/sketches" "faces=$work/drawn_faces"

  step profiles drawn_faces "$work/profiles/manifest.json" daumier dataset sketches \
    --config "$configs/sketches/side.toml" --out "$work/profiles" "faces=$work/drawn_faces"

  train parser "drawn_faces sketches profiles" "$configs/sketch/parser.toml" "data.faces=$work/drawn_faces" \
    "data.sketches=$work/sketches" "data.profiles=$work/profiles" "epochs=$parser_epochs"
  step eval_parser train_parser "$work/runs/parser/report/manifest.json" daumier eval "$work/runs/parser"
  ship parser drawn_faces sketches profiles train_parser eval_parser

  train sketch-ict "drawn_faces sketches" "$configs/sketch/drawings.toml" "data.faces=$work/drawn_faces" \
    "data.sketches=$work/sketches" "epochs=$sketch_epochs"
  step eval_sketch-ict train_sketch-ict "$work/runs/sketch-ict/report/manifest.json" \
    daumier eval "$work/runs/sketch-ict"
  ship sketch-ict drawn_faces sketches train_sketch-ict eval_sketch-ict
}

make_gestures() {
  step gestures "" "$work/gestures/manifest.json" daumier dataset gestures --config "$configs/gestures/strokes.toml" \
    --out "$work/gestures" "num_hands=$gesture_hands"
  train gestures gestures "$configs/gestures/cpu.toml" "data.gestures=$work/gestures" "epochs=$gesture_epochs"
  step eval_gestures train_gestures "$work/runs/gestures/report/manifest.json" daumier eval "$work/runs/gestures"
  ship gestures gestures train_gestures eval_gestures
}

for kind in $only; do
  case $kind in
    portraits | drawings | gestures) "make_$kind" ;;
    *) echo "ONLY: unknown kind '$kind' (expected portraits, drawings or gestures)" >&2; exit 2 ;;
  esac
done

du -sh "$out"/*
