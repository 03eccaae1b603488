#include "ablation/table.h"

#include "core/error.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

namespace daumier::ablation {
namespace {

/// Of the bootstraps; any number will do, but the same each time.
constexpr uint64_t kBootstrapSeed = 1;

using Results = std::vector<const AblationResult*>;

/// What equal texts have in common, the mean of numbers, key by key of objects; null where there is no such thing.
Json MeanOf(const std::vector<Json>& values) {
  if (std::all_of(values.begin(), values.end(), [&](const Json& value) { return value == values[0]; }))
    return values[0];
  if (std::all_of(values.begin(), values.end(), [](const Json& value) { return value.is_number(); })) {
    double sum = 0;
    for (const Json& value : values) sum += value.get<double>();
    return sum / double(values.size());
  }
  if (!std::all_of(values.begin(), values.end(), [](const Json& value) { return value.is_object(); })) return nullptr;
  Json mean = Json::object();
  for (const auto& [key, ignored] : values[0].items()) {
    std::vector<Json> entries;
    entries.reserve(values.size());
    for (const Json& value : values) entries.push_back(value.value(key, Json()));
    mean[key] = MeanOf(entries);
  }
  return mean;
}

template <class Function>
Json MeanOver(const Results& results, const Function& function) {
  std::vector<Json> values;
  for (const AblationResult* result : results) values.push_back(function(*result));
  return MeanOf(values);
}

struct PairedFaces {
  std::vector<double> errors;
  std::vector<int> groups;
};

/// The faces of all seeds in one list; nothing if a result does not tell its faces.
PairedFaces AllFaces(const Results& results) {
  PairedFaces faces;
  for (const AblationResult* result : results) {
    const AblationMeasure& measure = result->measure;
    if (measure.face_errors.empty()) return {};
    faces.errors.insert(faces.errors.end(), measure.face_errors.begin(), measure.face_errors.end());
    faces.groups.insert(faces.groups.end(), measure.groups.begin(), measure.groups.end());
  }
  return faces;
}

/// error - error of the reference, face by face, over the seeds that both have.
PairedFaces Differences(const Results& results, const Results& references) {
  PairedFaces faces;
  for (const AblationResult* result : results) {
    const auto reference = std::find_if(references.begin(), references.end(),
                                        [&](const AblationResult* other) { return other->seed == result->seed; });
    if (reference == references.end()) continue;
    const std::vector<double>&errors = result->measure.face_errors, &others = (*reference)->measure.face_errors;
    if (errors.empty() || others.empty()) continue;
    DAUMIER_CHECK(errors.size() == others.size(),
                  "'{}' was measured on {} faces and '{}' on {}: they cannot be compared", result->name, errors.size(),
                  (*reference)->name, others.size());
    for (size_t face = 0; face < errors.size(); ++face) faces.errors.push_back(errors[face] - others[face]);
    const std::vector<int>& groups = result->measure.groups;
    faces.groups.insert(faces.groups.end(), groups.begin(), groups.end());
  }
  return faces;
}

void SetInterval(Json& row, const std::string& key, const PairedFaces& faces) {
  if (faces.errors.empty()) return;
  const eval::Interval interval = eval::PersonBootstrap(faces.errors, faces.groups, kBootstrapSeed);
  row[key + "_low"] = interval.low;
  row[key + "_high"] = interval.high;
}

Json RowJson(const Results& results, const Results& references, const std::string& unit) {
  const AblationResult& first = *results.front();
  Json row = {{"name", first.name},
              {"split", first.split},
              {"baseline", first.baseline},
              {"paper", first.paper > 0 ? Json(first.paper) : Json()},
              {"unit", unit},
              {"error", MeanOver(results, [](const AblationResult& result) { return result.measure.error; })}};
  for (const char* key : {"error_low", "error_high", "errors", "seeds", "difference_to", "difference", "difference_low",
                          "difference_high", "steps", "parameters", "train_seconds", "infer_ms", "infer_threads"})
    row[key] = nullptr;
  if (results.size() == 1 && first.measure.interval) {
    row["error_low"] = first.measure.interval->low;
    row["error_high"] = first.measure.interval->high;
  } else {
    SetInterval(row, "error", AllFaces(results));
  }
  row["errors"] = row["seeds"] = Json::array();
  for (const AblationResult* result : results) {
    row["errors"].push_back(result->measure.error);
    row["seeds"].push_back(result->seed);
  }
  const PairedFaces differences = Differences(results, references);
  if (!references.empty() && references.front() != results.front() && !differences.errors.empty()) {
    row["difference_to"] = references.front()->name;
    row["difference"] = eval::Mean(differences.errors);
    SetInterval(row, "difference", differences);
  }
  if (std::all_of(results.begin(), results.end(), [](const AblationResult* result) { return result->cost; })) {
    row["steps"] = MeanOver(results, [](const AblationResult& result) { return result.cost->steps; });
    row["parameters"] = MeanOver(results, [](const AblationResult& result) { return result.cost->parameters; });
    row["train_seconds"] = MeanOver(results, [](const AblationResult& result) { return result.cost->train_seconds; });
    if (std::all_of(results.begin(), results.end(),
                    [](const AblationResult* result) { return result->cost->inference; })) {
      row["infer_ms"] = MeanOver(results, [](const AblationResult& result) { return result.cost->inference->ms; });
      row["infer_threads"] =
          MeanOver(results, [](const AblationResult& result) { return result.cost->inference->threads; });
    }
  }
  const Json more = MeanOver(results, [](const AblationResult& result) { return result.measure.more; });
  for (const auto& [key, value] : more.items()) row[key] = value;
  return row;
}

/// A number as a table shows it, or a dash.
std::string Cell(const Json& row, const std::string& key, const std::string& format) {
  const Json value = row.value(key, Json());
  if (value.is_null()) return "-";
  if (value.is_string()) return value.get<std::string>();
  return fmt::format(fmt::runtime(format), value.get<double>());
}

std::string IntervalCell(const Json& row, const std::string& key, const std::string& format) {
  if (row.value(key + "_low", Json()).is_null()) return "-";
  return Cell(row, key + "_low", format) + " to " + Cell(row, key + "_high", format);
}

std::string DifferenceCell(const Json& row) {
  if (row.value("difference", Json()).is_null()) return "-";
  return fmt::format("{} ({})", Cell(row, "difference", "{:+.2f}"), IntervalCell(row, "difference", "{:+.2f}"));
}

constexpr const char* kDifference = "difference";

struct Column {
  std::string title;  ///< "{unit}" stands for the unit of all errors.
  std::function<std::string(const Json& row)> cell;
};

Column Number(const std::string& title, const std::string& key, const std::string& format) {
  return {title, [key, format](const Json& row) { return Cell(row, key, format); }};
}

/// The columns of a split: those of every ablation, and of those that only some kinds of runs have the ones of which a
/// row has an entry.
std::vector<Column> ColumnsOf(const Json& table, const std::string& split) {
  std::vector<Column> columns = {{"row", [](const Json& row) { return row.at("name").get<std::string>(); }}};
  const auto any = [&](const std::string& key) {
    return std::any_of(table.begin(), table.end(),
                       [&](const Json& row) { return row.at("split") == split && !row.value(key, Json()).is_null(); });
  };
  const auto add_if_there = [&](const std::string& title, const std::string& key, const std::string& format) {
    if (any(key)) columns.push_back(Number(title, key, format));
  };
  add_if_there("shape input", "shape_input", "{}");
  columns.push_back(Number("paper {unit}", "paper", "{:.2f}"));
  if (any("measured_on")) {
    columns.push_back(Number("validation {unit}", "error", "{:.3f}"));
  } else {
    columns.push_back(Number("{unit}", "error", "{:.3f}"));
    columns.push_back({"95 % interval", [](const Json& row) { return IntervalCell(row, "error", "{:.2f}"); }});
    columns.push_back({kDifference, DifferenceCell});
  }
  add_if_there("p90", "p90", "{:.3f}");
  add_if_there("p95 of vertices", "p95", "{:.2f}");
  add_if_there("surface samples", "surface_sample_error_mm", "{:.3f}");
  add_if_there("% of head", "percent_of_head_height", "{:.2f}");
  add_if_there("normals, degrees", "normal_error_degrees", "{:.2f}");
  add_if_there("flips", "flipped_triangles", "{:.1f}");
  add_if_there("piercing pairs", "self_intersections", "{:.1f}");
  add_if_there("validation at equal time", "validation_at_equal_time", "{:.3f}");
  columns.push_back(Number("steps", "steps", "{:.0f}"));
  columns.push_back(Number("parameters", "parameters", "{:.0f}"));
  columns.push_back(Number("training s", "train_seconds", "{:.0f}"));
  add_if_there("ms a face", "infer_ms", "{:.2f}");
  columns.push_back({"seeds", [](const Json& row) { return fmt::format("{}", row.at("seeds").size()); }});
  return columns;
}

}  // namespace

Json AblationTableJson(const std::vector<AblationResult>& results, const std::string& unit,
                       const std::string& compare_to) {
  Json table = Json::array();
  std::vector<std::string> splits;
  for (const AblationResult& result : results)
    if (std::find(splits.begin(), splits.end(), result.split) == splits.end()) splits.push_back(result.split);
  for (const std::string& split : splits) {
    std::vector<Results> rows, baselines;
    for (const AblationResult& result : results) {
      if (result.split != split) continue;
      std::vector<Results>& list = result.baseline ? baselines : rows;
      const auto same =
          std::find_if(list.begin(), list.end(), [&](const Results& row) { return row.front()->name == result.name; });
      if (same == list.end()) {
        list.push_back({&result});
      } else {
        same->push_back(&result);
      }
    }
    const auto told = std::find_if(rows.begin(), rows.end(), [&](const Results& row) {
      return compare_to.empty() ? !row.front()->measure.face_errors.empty() : row.front()->name == compare_to;
    });
    const Results references = told == rows.end() ? Results{} : *told;
    for (const std::vector<Results>* list : {&baselines, &rows})
      for (const Results& row : *list) table.push_back(RowJson(row, references, unit));
  }
  return table;
}

std::vector<reports::ReportTable> AblationTables(const Json& table) {
  std::vector<reports::ReportTable> tables;
  std::vector<Column> columns;
  for (const Json& row : table) {
    const std::string title = fmt::format("Split: {}", row.at("split").get<std::string>());
    if (tables.empty() || tables.back().title != title) {
      columns = ColumnsOf(table, row.at("split").get<std::string>());
      tables.push_back({title, {}, {}});
      for (const Column& column : columns)
        tables.back().header.push_back(
            fmt::format(fmt::runtime(column.title), fmt::arg("unit", row.at("unit").get<std::string>())));
    }
    std::vector<std::string>& header = tables.back().header;
    if (const Json to = row.value("difference_to", Json()); to.is_string())
      std::replace(header.begin(), header.end(), std::string(kDifference), "against " + to.get<std::string>());
    std::vector<std::string> cells;
    cells.reserve(columns.size());
    for (const Column& column : columns) cells.push_back(column.cell(row));
    tables.back().rows.push_back(std::move(cells));
  }
  return tables;
}

std::string AblationMarkdown(const Json& table) {
  std::string text;
  for (const reports::ReportTable& one : AblationTables(table)) {
    text += fmt::format("## {}\n\n| {} |\n|---|", one.title, fmt::join(one.header, " | "));
    for (size_t column = 1; column < one.header.size(); ++column) text += "---:|";
    text += "\n";
    for (const auto& row : one.rows) text += fmt::format("| {} |\n", fmt::join(row, " | "));
    text += "\n";
  }
  return text + AblationFootnote() + "\n";
}

std::string AblationFootnote() {
  return "Errors are means over test faces and then over seeds. 95 % intervals come from a bootstrap over persons, "
         "each "
         "with all of its test faces of all seeds; seeds are not resampled, and errors of each seed stand in "
         "table.json. The difference is to one row, and paired by faces. The "
         "paper's figures are of the paper's "
         "own data. Milliseconds are the median of single faces on the CPU. Validation errors are the least of each "
         "training.";
}

}  // namespace daumier::ablation
