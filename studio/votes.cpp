#include "studio/votes.h"

#include "core/csv.h"
#include "core/error.h"
#include "core/files.h"
#include "core/folder_lock.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;

constexpr char kHeader[] = "participant,item,method,place,question,value,seconds";
constexpr size_t kCells = 7;
constexpr char kBest[] = "best";
constexpr double kMostPlace = 1e6;

/// A place, which is a whole number.
int PlaceOfCell(const CsvRow& row, size_t cell, const std::string& name) {
  const double number = CsvNumber(row, cell, name);
  DAUMIER_CHECK(number == std::floor(number) && std::abs(number) <= kMostPlace,
                "{}:{}: cell {} is '{}', expected a place", name, row.line, cell + 1, row.cells[cell]);
  return int(number);
}

double DeviationOf(const std::vector<double>& values, double mean) {
  if (values.size() < 2) return 0;
  const double squares = std::accumulate(values.begin(), values.end(), 0.0, [mean](double sum, double value) {
    return sum + (value - mean) * (value - mean);
  });
  return std::sqrt(squares / double(values.size() - 1));
}

}  // namespace

std::vector<Vote> ParseVotes(std::string_view text, const std::string& name) {
  const std::vector<CsvRow> rows = ParseCsv(text, name);
  DAUMIER_CHECK(!rows.empty() && fmt::format("{}", fmt::join(rows.front().cells, ",")) == kHeader,
                "{}: these are no votes: the first line is '{}', expected '{}'", name,
                rows.empty() ? "" : fmt::format("{}", fmt::join(rows.front().cells, ",")).substr(0, 80), kHeader);
  std::vector<Vote> votes;
  for (size_t i = 1; i < rows.size(); ++i) {
    const CsvRow& row = rows[i];
    DAUMIER_CHECK(row.cells.size() == kCells, "{}:{}: {} cells, expected {}", name, row.line, row.cells.size(), kCells);
    votes.push_back({row.cells[0], row.cells[1], row.cells[2], PlaceOfCell(row, 3, name), row.cells[4],
                     CsvNumber(row, 5, name), CsvNumber(row, 6, name)});
  }
  return votes;
}

std::vector<Vote> ReadVotes(const fs::path& file) {
  return ParseVotes(ReadFile(file), file.string());
}

std::string VotesText(const std::vector<Vote>& votes) {
  std::string text = fmt::format("{}\n", kHeader);
  for (const Vote& vote : votes)
    text += fmt::format("{},{},{},{},{},{},{}\n", CsvCell(vote.participant), CsvCell(vote.item), CsvCell(vote.method),
                        vote.place, CsvCell(vote.question), vote.value, vote.seconds);
  return text;
}

void AppendVotes(const fs::path& file, const std::vector<Vote>& votes) {
  const FolderLock lock(fs::absolute(file).parent_path());
  std::vector<Vote> all;
  if (fs::exists(file)) all = ReadVotes(file);
  all.insert(all.end(), votes.begin(), votes.end());
  WriteFileAtomically(file, VotesText(all));
}

std::vector<VoteSummary> SummariseVotes(const std::vector<Vote>& votes) {
  DAUMIER_CHECK(!votes.empty(), "there are no votes");
  constexpr uint64_t kSeed = 1;
  struct Values {
    std::vector<double> values;
    std::vector<int> participants;
  };
  std::vector<std::string> questions;
  std::map<std::string, int> numbers;
  std::map<std::pair<std::string, std::string>, Values> of_both;  // By question and method.
  for (const Vote& vote : votes) {
    if (std::ranges::find(questions, vote.question) == questions.end()) questions.push_back(vote.question);
    Values& values = of_both[{vote.question, vote.method}];
    values.values.push_back(vote.value);
    values.participants.push_back(numbers.emplace(vote.participant, int(numbers.size())).first->second);
  }
  std::vector<VoteSummary> summaries;
  for (const std::string& question : questions)
    for (const auto& [names, of_method] : of_both) {
      if (names.first != question) continue;
      const double mean = Mean(of_method.values);
      summaries.push_back({question, names.second, int(of_method.values.size()), mean,
                           DeviationOf(of_method.values, mean),
                           PersonBootstrap(of_method.values, of_method.participants, kSeed)});
    }
  return summaries;
}

reports::ReportTable VoteTable(const std::vector<VoteSummary>& summaries) {
  reports::ReportTable table{
      .title = "Votes", .header = {"question", "method", "votes", "mean", "deviation", "95 % interval"}, .rows = {}};
  for (const VoteSummary& summary : summaries) {
    const std::string count = summary.question == kBest
                                  ? fmt::format("{:.0f} of {}", summary.mean * summary.num_votes, summary.num_votes)
                                  : fmt::format("{}", summary.num_votes);
    table.rows.push_back({summary.question, summary.method, count, fmt::format("{:.2f}", summary.mean),
                          fmt::format("{:.2f}", summary.deviation),
                          fmt::format("{:.2f} to {:.2f}", summary.interval.low, summary.interval.high)});
  }
  return table;
}

Json VotesToJson(const std::vector<Vote>& votes, const std::vector<VoteSummary>& summaries) {
  std::set<std::string> participants, items;
  for (const Vote& vote : votes) {
    participants.insert(vote.participant);
    items.insert(vote.item);
  }
  Json methods = Json::array();
  for (const VoteSummary& summary : summaries)
    methods.push_back({{"question", summary.question},
                       {"method", summary.method},
                       {"votes", summary.num_votes},
                       {"mean", summary.mean},
                       {"deviation", summary.deviation},
                       {"mean_low", summary.interval.low},
                       {"mean_high", summary.interval.high}});
  return {{"votes", votes.size()},
          {"participants", participants.size()},
          {"items", items.size()},
          {"methods", std::move(methods)}};
}

}  // namespace daumier::studio
