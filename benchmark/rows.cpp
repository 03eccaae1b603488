#include "benchmark/rows.h"

#include "core/error.h"
#include "core/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace daumier::benchmark {
namespace {

constexpr uint64_t kDifferenceSeed = 1;
constexpr const char *kSurface = "surface_error_mm", *kVertices = "vertex_error_mm", *kNme = "nme_percent";
/// Rows of one table agree in these.
constexpr const char* kCommonKeys[] = {"benchmark", "kit_hash", "task", "split", "num_items"};

std::string TextIn(const Json& row, const char* key) {
  const Json method = row.value("method", Json::object());
  return method.is_object() && method.contains(key) && method.at(key).is_string() ? method.at(key).get<std::string>()
                                                                                  : std::string("-");
}

struct ItemErrors {
  std::map<std::string, double> errors;
  std::map<std::string, int> persons;
};

ItemErrors ErrorsOfItems(const Json& row, const std::string& measure) {
  ItemErrors result;
  for (const Json& item : row.at("items")) {
    const auto name = item.at("name").get<std::string>();
    result.errors[name] = item.at(measure).get<double>();
    result.persons[name] = item.at("person").get<int>();
  }
  DAUMIER_CHECK(result.errors.size() == row.at("num_items").get<size_t>(), "the row '{}' has {} items of {}",
                TextIn(row, "name"), result.errors.size(), row.at("num_items").get<size_t>());
  return result;
}

Json DifferenceOf(const ItemErrors& errors, const ItemErrors& best, const std::string& name) {
  std::vector<double> differences;
  std::vector<int> persons;
  for (const auto& [item, error] : best.errors) {
    const auto found = errors.errors.find(item);
    DAUMIER_CHECK(found != errors.errors.end(), "the row '{}' has no item {}", name, item);
    differences.push_back(found->second - error);
    persons.push_back(best.persons.at(item));
  }
  const Interval interval = PersonBootstrap(differences, persons, kDifferenceSeed);
  return {{"mean", Mean(differences)}, {"low", interval.low}, {"high", interval.high}};
}

std::string WithInterval(const Json& numbers) {
  return fmt::format("{:.2f} ({:.2f} to {:.2f})", numbers.at("mean").get<double>(), numbers.at("low").get<double>(),
                     numbers.at("high").get<double>());
}

}  // namespace

Json SummariseRows(std::span<const Json> rows) {
  DAUMIER_CHECK(!rows.empty(), "there is no row");
  try {
    const Json& first = rows.front();
    const std::string measure = first.contains(kNme) ? kNme : kSurface;
    std::vector<size_t> order;
    for (size_t i = 0; i < rows.size(); ++i) {
      for (const char* key : kCommonKeys)
        DAUMIER_CHECK(rows[i].at(key) == first.at(key),
                      "the row '{}' has {} {}, but '{}' has {}. Score both on one kit: daumier benchmark make",
                      TextIn(rows[i], "name"), key, rows[i].at(key).dump(), TextIn(first, "name"),
                      first.at(key).dump());
      order.push_back(i);
    }
    std::ranges::stable_sort(order, {}, [&](size_t i) { return rows[i].at(measure).at("mean").get<double>(); });
    Json summary = {{"measure", measure}};
    for (const char* key : kCommonKeys) summary[key] = first.at(key);
    const ItemErrors best = ErrorsOfItems(rows[order.front()], measure);
    for (const size_t i : order) {
      Json row = rows[i];
      row["difference"] = DifferenceOf(ErrorsOfItems(row, measure), best, TextIn(row, "name"));
      for (const char* key : kCommonKeys) row.erase(key);
      row.erase("items");
      summary["rows"].push_back(std::move(row));
    }
    return summary;
  } catch (const Json::exception& error) {
    throw Error(fmt::format("this is no row of `daumier score --benchmark --json`: {}", TextOf(error)));
  }
}

reports::ReportTable RowsTable(const Json& summary) {
  const auto measure = summary.at("measure").get<std::string>();
  const bool is_nme = measure == kNme;
  reports::ReportTable table{summary.at("task").get<std::string>(), {"method", "trained on"}, {}};
  if (is_nme) {
    table.header.emplace_back("NME, % (95 %)");
  } else {
    table.header.insert(table.header.end(), {"surface, mm (95 %)", "vertices, mm (95 %)"});
  }
  table.header.insert(table.header.end(), {"median", "p90", "worse than the first by", "missing"});
  for (const Json& row : summary.at("rows")) {
    std::vector<std::string> cells = {TextIn(row, "name"), TextIn(row, "training_data"), WithInterval(row.at(measure))};
    if (!is_nme) cells.push_back(row.contains(kVertices) ? WithInterval(row.at(kVertices)) : "-");
    cells.push_back(fmt::format("{:.2f}", row.at(measure).at("median").get<double>()));
    cells.push_back(fmt::format("{:.2f}", row.at(measure).at("p90").get<double>()));
    cells.push_back(table.rows.empty() ? "-" : WithInterval(row.at("difference")));
    cells.push_back(fmt::format("{} of {}", row.at("num_missing").get<int>(), summary.at("num_items").get<int>()));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

}  // namespace daumier::benchmark
