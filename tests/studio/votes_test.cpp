#include "studio/votes.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

namespace daumier::studio {
namespace {

using testing::ExpectError;

constexpr char kVotesHeader[] = "participant,item,method,place,question,value,seconds\n";

std::vector<Vote> Ratings(const std::vector<std::pair<std::string, double>>& by_participant,
                          const std::string& method = "a") {
  std::vector<Vote> votes;
  for (const auto& [participant, value] : by_participant)
    votes.push_back({participant, "face", method, 1, "accuracy", value, 2});
  return votes;
}

TEST(Votes, TextGivesTheSameVotes) {
  const std::vector<Vote> votes = {{"1", "face, young", "said \"best\"", 2, "best", 1, 3.25},
                                   {"2", "two\nlines", "b", 1, "similarity", 4, 0.5}};
  const std::vector<Vote> read = ParseVotes(VotesText(votes), "x");
  ASSERT_EQ(read.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read[i].participant, votes[i].participant);
    EXPECT_EQ(read[i].item, votes[i].item);
    EXPECT_EQ(read[i].method, votes[i].method);
    EXPECT_EQ(read[i].place, votes[i].place);
    EXPECT_EQ(read[i].question, votes[i].question);
    EXPECT_EQ(read[i].value, votes[i].value);
    EXPECT_EQ(read[i].seconds, votes[i].seconds);
  }
}

TEST(Votes, SpreadsheetsMaySaveThem) {
  const std::string text = std::string("\xEF\xBB\xBF") +
                           "participant,item,method,place,question,value,seconds\r\n\"1\",a,b,1,best,1,2\r\n\r\n";
  const std::vector<Vote> votes = ParseVotes(text, "x");
  ASSERT_EQ(votes.size(), 1u);
  EXPECT_EQ(votes[0].participant, "1");
  EXPECT_EQ(votes[0].seconds, 2);
}

TEST(Votes, WrongFilesAreRefusedByLine) {
  ExpectError([] { ParseVotes("", "v.csv"); }, "v.csv: these are no votes");
  ExpectError([] { ParseVotes("a,b\n", "v.csv"); }, "the first line is 'a,b'");
  ExpectError([] { ParseVotes(std::string(kVotesHeader) + "1,a,b,1,best,1,2\n1,a,b\n", "v.csv"); },
              "v.csv:3: 3 cells, expected 7");
  ExpectError([] { ParseVotes(std::string(kVotesHeader) + "1,a,b,1,best,one,2\n", "v.csv"); },
              "v.csv:2: cell 6 is 'one'");
  ExpectError([] { ParseVotes(std::string(kVotesHeader) + "1,\"a\n", "v.csv"); }, "v.csv:2: a quote is not closed");
}

TEST(Votes, AppendingKeepsWhatIsThere) {
  const testing::TempDir folder;
  const auto file = folder / "votes.csv";
  AppendVotes(file, Ratings({{"1", 3}}));
  AppendVotes(file, Ratings({{"2", 4}, {"3", 5}}));
  const std::vector<Vote> votes = ReadVotes(file);
  ASSERT_EQ(votes.size(), 3u);
  EXPECT_EQ(votes[2].value, 5);
  WriteFileAtomically(folder / "notes.csv", "mine\n");
  ExpectError([&] { AppendVotes(folder / "notes.csv", Ratings({{"1", 3}})); }, "these are no votes");
  EXPECT_EQ(ReadFile(folder / "notes.csv"), "mine\n");
}

TEST(Votes, SeveralMayAppendAtATime) {
  const testing::TempDir folder;
  const auto file = folder / "votes.csv";
  std::vector<std::thread> threads;
  for (int person = 1; person <= 4; ++person)
    threads.emplace_back([&file, person] {
      for (int i = 0; i < 5; ++i) AppendVotes(file, Ratings({{std::to_string(person), i}}));
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(ReadVotes(file).size(), 20u);
}

TEST(Votes, MeanAndDeviationAreThoseWorkedOutByHand) {
  std::vector<Vote> votes = Ratings({{"1", 2}, {"2", 4}, {"3", 4}, {"4", 4}, {"5", 5}, {"6", 5}}, "ours");
  for (const Vote& vote : Ratings({{"1", 1}}, "other")) votes.push_back(vote);
  const std::vector<VoteSummary> summaries = SummariseVotes(votes);
  ASSERT_EQ(summaries.size(), 2u);
  EXPECT_EQ(summaries[0].method, "other");
  EXPECT_EQ(summaries[0].deviation, 0);
  EXPECT_EQ(summaries[0].interval.low, 1);
  EXPECT_EQ(summaries[0].interval.high, 1);
  const VoteSummary& ours = summaries[1];
  EXPECT_EQ(ours.num_votes, 6);
  EXPECT_DOUBLE_EQ(ours.mean, 4);
  EXPECT_DOUBLE_EQ(ours.deviation, std::sqrt(6.0 / 5));
  EXPECT_LT(ours.interval.low, 4);
  EXPECT_GT(ours.interval.high, 4);
}

TEST(Votes, TheIntervalIsOverParticipantsAndNotOverVotes) {
  // Ten equal votes each of two participants: as uncertain as two votes.
  std::vector<Vote> votes;
  for (int i = 0; i < 10; ++i)
    for (const Vote& vote : Ratings({{"1", 1}, {"2", 5}})) votes.push_back(vote);
  const VoteSummary summary = SummariseVotes(votes).front();
  EXPECT_EQ(summary.interval.low, 1);
  EXPECT_EQ(summary.interval.high, 5);
}

TEST(Votes, TheTableCountsHowOftenAMethodWasChosen) {
  std::vector<Vote> votes;
  for (int i = 0; i < 4; ++i) {
    votes.push_back({std::to_string(i), "face", "ours", 1, "best", i < 3 ? 1.0 : 0.0, 1});
    votes.push_back({std::to_string(i), "face", "other", 2, "best", i < 3 ? 0.0 : 1.0, 1});
  }
  votes.push_back({"0", "face", "ours", 1, "accuracy", 5, 1});
  const std::vector<VoteSummary> summaries = SummariseVotes(votes);
  const reports::ReportTable table = VoteTable(summaries);
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"best", "ours", "3 of 4", "0.75", "0.50", "0.25 to 1.00"}));
  EXPECT_EQ(table.rows[2][0], "accuracy") << "questions in order of their first vote";
  EXPECT_EQ(table.rows[2][2], "1");
  const Json json = VotesToJson(votes, summaries);
  EXPECT_EQ(json.at("votes"), 9);
  EXPECT_EQ(json.at("participants"), 4);
  EXPECT_EQ(json.at("items"), 1);
  EXPECT_EQ(json.at("methods")[1].at("mean"), 0.75);
  ExpectError([] { SummariseVotes({}); }, "there are no votes");
}

}  // namespace
}  // namespace daumier::studio
