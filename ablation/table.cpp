#include "ablation/table.h"

#include "core/error.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

namespace daumier::ablation {
namespace {

/// Of the bootstraps.
constexpr uint64_t kBootstrapSeed = 1;

using Results = std::vector<const AblationResult*>;

/// Equal values: that value. Numbers: their mean. Objects: the same for each key. Otherwise null.
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

/// The faces of all seeds in one list; empty if a result has no face errors.
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
  const Interval interval = PersonBootstrap(faces.errors, faces.groups, kBootstrapSeed);
  row[key + "_low"] = interval.low;
  row[key + "_high"] = interval.high;
}

Json RowJson(const Results& results, const Results& references) {
  const AblationResult& first = *results.front();
  Json row = {{"name", first.name},
              {"split", first.split},
              {"baseline", first.baseline},
              {"paper", first.paper > 0 ? Json(first.paper) : Json()},
              {"unit", "mm"},
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
    row["difference"] = Mean(differences.errors);
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

/// The columns of the rows of one split. The first one is in each row of table.json.
std::vector<reports::Metric> ColumnsOf(const Json& rows, const std::vector<reports::Metric>& further) {
  using reports::ShowInterval;
  const std::string unit = rows.front().at("unit").get<std::string>();
  const auto any = [&](const char* key) {
    return std::any_of(rows.begin(), rows.end(), [&](const Json& row) { return !row.value(key, Json()).is_null(); });
  };
  std::vector<reports::Metric> columns = {{.key = "paper", .title = "paper " + unit, .digits = 2}};
  if (any("measured_on")) {
    columns.push_back({.key = "error", .title = "validation " + unit});
  } else {
    std::string difference = "difference";
    for (const Json& row : rows)
      if (const Json to = row.value("difference_to", Json()); to.is_string())
        difference = "against " + to.get<std::string>();
    columns.push_back({.key = "error", .title = unit, .interval = ShowInterval::kInColumn, .interval_digits = 2});
    columns.push_back({.key = "difference",
                       .title = difference,
                       .digits = 2,
                       .interval = ShowInterval::kInCell,
                       .interval_digits = 2,
                       .sign = true});
  }
  columns.insert(columns.end(), further.begin(), further.end());
  columns.push_back({.key = "validation_at_equal_time", .title = "validation at equal time", .may_hide = true});
  columns.push_back({.key = "steps", .title = "steps", .digits = 0});
  columns.push_back({.key = "parameters", .title = "parameters", .digits = 0});
  columns.push_back({.key = "train_seconds", .title = "training s", .digits = 0});
  columns.push_back({.key = "infer_ms", .title = "ms a face", .digits = 2, .may_hide = true});
  columns.push_back({.key = "num_seeds", .title = "seeds", .digits = 0});
  return columns;
}

}  // namespace

Json AblationTableJson(const std::vector<AblationResult>& results, const std::string& compare_to) {
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
    const auto reference = std::find_if(rows.begin(), rows.end(), [&](const Results& row) {
      return compare_to.empty() ? !row.front()->measure.face_errors.empty() : row.front()->name == compare_to;
    });
    const Results references = reference == rows.end() ? Results{} : *reference;
    for (const std::vector<Results>* list : {&baselines, &rows})
      for (const Results& row : *list) table.push_back(RowJson(row, references));
  }
  return table;
}

std::vector<reports::ReportTable> AblationTables(const Json& table, const std::vector<reports::Metric>& columns) {
  std::vector<reports::ReportTable> tables;
  for (size_t begin = 0, end = 0; begin < table.size(); begin = end) {
    const Json& split = table[begin].at("split");
    Json rows = Json::array();
    for (; end < table.size() && table[end].at("split") == split; ++end) {
      rows.push_back(table[end]);
      rows.back()["num_seeds"] = rows.back().at("seeds").size();
    }
    reports::MetricTable of_split{.columns = ColumnsOf(rows, columns)};
    of_split.rows = reports::RowsFromJson(rows, of_split.columns);
    tables.push_back(reports::TextTable(of_split, fmt::format("Split: {}", split.get<std::string>()), "row"));
  }
  return tables;
}

std::string AblationMarkdown(const Json& table, const std::vector<reports::Metric>& columns) {
  std::string text;
  for (const reports::ReportTable& one : AblationTables(table, columns))
    text += fmt::format("## {}\n\n{}\n", one.title, reports::TableMarkdown(one));
  return text + AblationFootnote() + "\n";
}

std::string AblationFootnote() {
  return "Errors are means over test faces and then over seeds. 95 % intervals come from a bootstrap over persons, "
         "each "
         "with all of its test faces of all seeds; seeds are not resampled, and table.json has the errors of each "
         "seed. "
         "The difference is to one row, and paired by faces. The paper's figures are of the paper's own data. "
         "Milliseconds are the median of single faces on the CPU. Validation errors are the least of each training.";
}

}  // namespace daumier::ablation
