# Reads the map of rooms, the daumier_room(...) lines of the root CMakeLists.txt, for tools/check_layers and tools/check_rooms.
# Form of a line: daumier_room(NAME SEES rooms... USES libraries... TORCH). NAME is a folder, possibly nested: systems/sketch.
# After read_map(file): rooms[1..num_rooms] in their order, is_room[room], has_torch[room], sees[room, other] for each other
# room that `room` may include, and sees_list[room], the same in order, separated by spaces.

function fail(message) {
  print message
  num_failures++
}

# The room of a file, the longest room that is a prefix of its folder; tests/ROOM/... belongs to ROOM. "" if there is none.
function room_of(path) {
  sub(/^tests\//, "", path)
  while (sub(/\/[^\/]*$/, "", path)) if (path in is_room) return path
  return ""
}

function read_line(file, line,    words, count, i, in_sees, room, others, num_others) {
  if (line !~ /\)[ \t]*$/) fail(file ": daumier_room must be on one line: " line)
  gsub(/^daumier_room\(|\)[ \t]*$/, "", line)
  count = split(line, words, /[ \t]+/)
  room = words[1]
  if (room in is_room) fail(file ": room " room " is on the map twice")
  rooms[++num_rooms] = room
  is_room[room] = 1
  for (i = 2; i <= count; i++) {
    if (words[i] == "SEES" || words[i] == "USES" || words[i] == "TORCH") {
      in_sees = (words[i] == "SEES")
      if (words[i] == "TORCH") has_torch[room] = 1
    } else if (in_sees) {
      if (words[i] in is_room && words[i] != room) others[++num_others] = words[i]
      else fail(file ": room " room " sees " words[i] ", which is not a room above it")
    }
  }
  for (i = 1; i <= num_others; i++) {
    sees[room, others[i]] = 1
    sees_list[room] = sees_list[room] " " others[i]
    if (others[i] in has_torch && !(room in has_torch)) {
      fail(file ": room " room " without TORCH sees " others[i] " with TORCH")
    }
  }
}

function read_map(file,    line) {
  while ((getline line < file) > 0) if (line ~ /^daumier_room\(/) read_line(file, line)
  close(file)
  if (num_rooms == 0) fail(file ": contains no daumier_room line")
}
