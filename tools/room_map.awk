# Reads the map of rooms, the daumier_room(...) lines of the root CMakeLists.txt, for tools/check_layers and tools/check_rooms.
# After read_map(file): rooms[1..num_rooms] in their order, is_room[room], has_torch[room], and sees[room, other] for every
# other that `room` may include, itself among them.

function fail(message) {
  print message
  num_failures++
}

function read_map(file,    line, words, count, i, in_sees) {
  while ((getline line < file) > 0) {
    if (line !~ /^daumier_room\(/) continue
    if (line !~ /\)[ \t]*$/) fail(file ": a room has to stand in one line: " line)
    gsub(/^daumier_room\(|\)[ \t]*$/, "", line)
    count = split(line, words, /[ \t]+/)
    rooms[++num_rooms] = words[1]
    is_room[words[1]] = 1
    sees[words[1], words[1]] = 1
    in_sees = 0
    for (i = 2; i <= count; i++) {
      if (words[i] == "SEES" || words[i] == "USES" || words[i] == "TORCH") {
        in_sees = (words[i] == "SEES")
        if (words[i] == "TORCH") has_torch[words[1]] = 1
      } else if (in_sees) {
        if (!(words[i] in is_room)) fail(file ": " words[1] " sees " words[i] ", which is no room above it")
        sees[words[1], words[i]] = 1
      }
    }
  }
  close(file)
  if (num_rooms == 0) fail(file ": has no daumier_room line")
}
