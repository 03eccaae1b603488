#include "rig/clip_csv.h"

#include "core/error.h"
#include "faces/text_table.h"
#include "rig/recording_builder.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace daumier::rig {
namespace {

using ClipRow = faces::TextTable::Row;

constexpr double kAssumedRate = 60;  ///< Of Live Link Face.

/// Letters and digits of a name, in lower case: "BlendShapeCount" and "blend_shape_count" are equal.
std::string PlainName(std::string_view name) {
  std::string plain;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)))
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return plain;
}

struct TurnColumn {
  TurnedPart part;
  int axis;     ///< 0 pitch, 1 yaw, 2 roll.
  double sign;  ///< From the app's direction to that of WeightsClip.
};

/// Signs of pitch and yaw are measured on a recording; that of roll follows, as the app mirrors left and right.
std::optional<TurnColumn> TurnOf(const std::string& plain) {
  constexpr std::pair<std::string_view, TurnedPart> kParts[] = {
      {"head", TurnedPart::kHead}, {"righteye", TurnedPart::kRightEye}, {"lefteye", TurnedPart::kLeftEye}};
  constexpr std::pair<std::string_view, double> kAxes[] = {{"pitch", 1.0}, {"yaw", -1.0}, {"roll", -1.0}};
  for (const auto& [part_name, part] : kParts)
    for (int axis = 0; axis < 3; ++axis)
      if (plain == std::string(part_name) + std::string(kAxes[axis].first))
        return TurnColumn{part, axis, kAxes[axis].second};
  return std::nullopt;
}

/// Which columns are what.
struct ClipColumns {
  size_t num_columns = 0;
  std::vector<std::string> names = {};
  std::map<size_t, int> targets = {};
  std::map<size_t, TurnColumn> turns = {};
  std::optional<size_t> time = {}, count = {};
  bool is_milliseconds = false;
};

ClipColumns ColumnsOf(const ClipRow& header, const std::string& file, RecordingBuilder& builder) {
  static const std::set<std::string> kTimes = {"timecode", "time",    "times",       "t",          "timestamp",
                                               "seconds",  "timesec", "timeseconds", "timestamps", "sec"};
  static const std::set<std::string> kMilliseconds = {"timems", "timestampms", "ms", "milliseconds",
                                                      "timemilliseconds"};
  static const std::set<std::string> kIgnored = {"",      "frame",  "frames", "frameindex", "framenumber",
                                                 "index", "neutral"};
  ClipColumns columns{.num_columns = header.cells.size(), .names = header.cells};
  std::map<int, std::string> seen;
  for (size_t c = 0; c < header.cells.size(); ++c) {
    const std::string& cell = header.cells[c];
    const std::string plain = PlainName(cell);
    if (kMilliseconds.contains(plain) || kTimes.contains(plain)) {
      if (!columns.time) columns.is_milliseconds = kMilliseconds.contains(plain);
      if (!columns.time) columns.time = c;
    } else if (plain == "blendshapecount") {
      columns.count = c;
    } else if (const auto turn = TurnOf(plain)) {
      columns.turns.emplace(c, *turn);
    } else if (!kIgnored.contains(plain)) {
      const auto target = builder.FindTarget(std::string_view(cell).substr(cell.rfind('.') + 1));
      if (!target) continue;
      const auto [earlier, is_new] = seen.emplace(*target, cell);
      DAUMIER_CHECK(is_new, "{}: line {}: the columns '{}' and '{}' are the same target. Remove one of them", file,
                    header.line, earlier->second, cell);
      columns.targets.emplace(c, *target);
    }
  }
  DAUMIER_CHECK(!columns.targets.empty(),
                "{}: line {}: no column is an ARKit target (found '{}' first; expected names such as jawOpen, JawOpen "
                "or eyeBlink_L). The first line of a clip names its columns",
                file, header.line, header.cells.front());
  return columns;
}

std::optional<double> ClipNumber(std::string_view cell) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double number = 0;
  const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  if (error != std::errc() || stop != cell.data() + cell.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

/// Whole seconds and frames of HH:MM:SS:FF.mmm; of HH:MM:SS.mmm, seconds alone.
struct Timecode {
  double seconds = 0;
  std::optional<double> frames;
};

std::optional<Timecode> ParseTimecode(std::string_view cell) {
  std::vector<double> parts;
  for (size_t begin = 0; begin <= cell.size();) {
    const size_t end = std::min(cell.find(':', begin), cell.size());
    const auto number = ClipNumber(cell.substr(begin, end - begin));
    if (!number || *number < 0 || *number > 1e4) return std::nullopt;
    parts.push_back(*number);
    begin = end + 1;
  }
  if (parts.size() != 3 && parts.size() != 4) return std::nullopt;
  Timecode timecode{3600 * parts[0] + 60 * parts[1] + parts[2], std::nullopt};
  if (parts.size() == 4) timecode.frames = parts[3];
  return timecode;
}

/// The usual rate above the largest number of a frame, if a whole second was counted.
double RateOf(const std::vector<Timecode>& timecodes) {
  double largest = 0;
  std::set<double> seconds;
  for (const Timecode& timecode : timecodes) {
    largest = std::max(largest, std::floor(timecode.frames.value_or(0)));
    seconds.insert(timecode.seconds);
  }
  if (seconds.size() < 2 && largest < kAssumedRate) return kAssumedRate;
  for (const double rate : {24.0, 25.0, 30.0, 50.0, 60.0, 120.0, 240.0})
    if (largest < rate) return rate;
  return largest + 1;
}

/// A row's time for people.
std::string PlaceOf(const ClipRow& row) {
  return fmt::format("line {}", row.line);
}

/// Seconds of rows by their timecodes; one that passes midnight continues.
std::vector<double> SecondsOfTimecodes(const std::vector<ClipRow>& rows, size_t column, const std::string& file) {
  std::vector<Timecode> timecodes;
  for (const ClipRow& row : rows) {
    const auto timecode = ParseTimecode(row.cells[column]);
    DAUMIER_CHECK(timecode, "{}: {}: '{}' is no timecode (expected HH:MM:SS:FF.mmm). Remove the row", file,
                  PlaceOf(row), row.cells[column]);
    timecodes.push_back(*timecode);
  }
  constexpr double kDay = 86400;
  const double rate = RateOf(timecodes);
  std::vector<double> seconds;
  double days = 0;
  for (const Timecode& timecode : timecodes) {
    double time = timecode.seconds + timecode.frames.value_or(0) / rate + days;
    if (!seconds.empty() && time < seconds.back() - kDay / 2) {
      days += kDay;
      time += kDay;
    }
    seconds.push_back(time);
  }
  return seconds;
}

/// Seconds of every row.
std::vector<double> TimesOf(const std::vector<ClipRow>& rows, const ClipColumns& columns, const std::string& file,
                            RecordingBuilder& builder) {
  std::vector<double> times;
  if (!columns.time) {
    builder.Warn(fmt::format("states no times: {} frames a second are assumed", kAssumedRate));
    for (size_t i = 0; i < rows.size(); ++i) times.push_back(double(i) / kAssumedRate);
    return times;
  }
  if (rows.front().cells[*columns.time].find(':') != std::string::npos)
    return SecondsOfTimecodes(rows, *columns.time, file);
  for (const ClipRow& row : rows) {
    const std::string& cell = row.cells[*columns.time];
    const auto number = ClipNumber(cell);
    DAUMIER_CHECK(number, "{}: {}: column {}: '{}' is no time (expected a number). Remove the row", file, PlaceOf(row),
                  columns.names[*columns.time], cell);
    times.push_back(*number);
  }
  return SecondsOf(std::move(times), columns.is_milliseconds);
}

bool HasFace(const ClipRow& row, const ClipColumns& columns) {
  if (columns.count && *columns.count < row.cells.size() && ClipNumber(row.cells[*columns.count]) == 0.0) return false;
  return std::ranges::any_of(columns.targets, [&](const auto& column) {
    return column.first < row.cells.size() && !row.cells[column.first].empty();
  });
}

/// @throws Error unless the row has a cell a column; empty ones may follow.
void CheckWidth(ClipRow& row, const ClipColumns& columns, const std::string& file) {
  while (row.cells.size() > columns.num_columns && row.cells.back().empty()) row.cells.pop_back();
  DAUMIER_CHECK(row.cells.size() == columns.num_columns,
                "{}: {}: {} cells, expected {} as in the header. The file is cut or was edited: remove the row", file,
                PlaceOf(row), row.cells.size(), columns.num_columns);
}

double NumberAt(const ClipRow& row, size_t column, const ClipColumns& columns, const std::string& file) {
  const auto number = ClipNumber(row.cells[column]);
  DAUMIER_CHECK(number, "{}: {}: column {}: '{}' is no number. Correct the cell, or remove the row", file, PlaceOf(row),
                columns.names[column], row.cells[column]);
  return *number;
}

}  // namespace

Recording ParseClipCsv(std::string_view text, const std::string& name) {
  DAUMIER_CHECK(text.find('\0') == std::string_view::npos,
                "{}: is binary (expected a clip as CSV or JSON text; docs/heads.md lists the formats)", name);
  faces::TextTable table = faces::ReadTextTable(text, name);
  DAUMIER_CHECK(!table.rows.empty(), "{}: is empty (expected a line with names of columns, then a row a frame)", name);
  RecordingBuilder builder(name);
  const ClipColumns columns = ColumnsOf(table.rows.front(), name, builder);
  std::vector<ClipRow> rows;
  for (size_t i = 1; i < table.rows.size(); ++i) {
    if (!HasFace(table.rows[i], columns)) {
      builder.CountWithoutFace();
      continue;
    }
    CheckWidth(table.rows[i], columns, name);
    rows.push_back(std::move(table.rows[i]));
  }
  DAUMIER_CHECK(!rows.empty(), "{}: contains no row with a face below its header", name);
  const std::vector<double> seconds = TimesOf(rows, columns, name, builder);
  for (size_t i = 0; i < rows.size(); ++i) {
    builder.AddFrame(seconds[i], PlaceOf(rows[i]));
    for (const auto& [column, target] : columns.targets)
      builder.SetWeight(target, NumberAt(rows[i], column, columns, name));
    std::map<TurnedPart, std::array<double, 3>> turns;
    for (const auto& [column, turn] : columns.turns)
      turns[turn.part][size_t(turn.axis)] = turn.sign * NumberAt(rows[i], column, columns, name);
    for (const auto& [part, turn] : turns) builder.SetTurn(part, turn);
  }
  return builder.Finish(std::nullopt);
}

}  // namespace daumier::rig
