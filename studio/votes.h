#pragma once
#include "core/json.h"
#include "core/statistics.h"
#include "reports/report_table.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::studio {

/// What a participant of a study said about one method's result of one item.
struct Vote {
  std::string participant, item, method;
  int place = 0;         ///< Where the result was shown, from 1.
  std::string question;  ///< "best", "aesthetics", ...
  double value = 0;      ///< Of "best" 1 if it was chosen and 0 if not; else the rating.
  double seconds = 0;    ///< That the participant took for the item.
};

/// Reads comma-separated lines with the header participant,item,method,place,question,value,seconds [RFC 4180: texts in quotes may hold
/// commas and lines]. @throws Error naming `name`, the line and the cause.
std::vector<Vote> ParseVotes(std::string_view text, const std::string& name);
/// ParseVotes of a file. @throws Error also if it cannot be read.
std::vector<Vote> ReadVotes(const std::filesystem::path& file);
/// Undoes ParseVotes: the header and a line a vote.
std::string VotesText(const std::vector<Vote>& votes);
/// Adds votes to the end of a file, which is made where it is missing. Readers see all of them or none; several programs may write at a
/// time. @throws Error as ReadVotes and WriteFileAtomically.
void AppendVotes(const std::filesystem::path& file, const std::vector<Vote>& votes);

/// The votes of one question about one method.
struct VoteSummary {
  std::string question, method;
  int num_votes = 0;
  double mean = 0;
  double deviation = 0;        ///< Standard deviation with n - 1; 0 of one vote.
  Interval interval = {0, 0};  ///< 95 % of the mean, by PersonBootstrap over participants.
};

/// Questions in order of their first vote, methods by name. @throws Error if there is no vote.
std::vector<VoteSummary> SummariseVotes(const std::vector<Vote>& votes);

/// Question, method, votes (of "best" how often the method was chosen), mean, deviation, interval.
reports::ReportTable VoteTable(const std::vector<VoteSummary>& summaries);
/// {votes, participants, items, methods: [{question, method, votes, mean, deviation, mean_low, mean_high}, ...]}.
Json VotesToJson(const std::vector<Vote>& votes, const std::vector<VoteSummary>& summaries);

}  // namespace daumier::studio
