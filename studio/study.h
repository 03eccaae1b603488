#pragma once
#include "core/options.h"
#include "studio/api.h"
#include "studio/display_head.h"
#include "studio/votes.h"

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace daumier::studio {

/// How participants judge the results of an item.
enum class VoteKind {
  kBest,     ///< Which one is the best [Han et al. 2017, section 6.1, stage II].
  kRatings,  ///< Aesthetics, accuracy and similarity of each, 1 to 5 [Pan et al. 2024, table 3].
};

/// A picture and what methods made of it.
struct StudyItem {
  struct Result {
    std::string method;
    std::filesystem::path file;
    bool is_mesh = false;
  };
  std::string name;
  std::filesystem::path source;
  std::vector<Result> results;  ///< By method.
};

/// folder/NAME/source.png (or .jpg, .jpeg, .webp) and METHOD.obj, .ply, .png, .jpg, .jpeg or .webp of two to six methods, by NAME.
/// @throws Error naming the folder and what is missing.
std::vector<StudyItem> ReadStudyItems(const std::filesystem::path& folder);

/// In which order a participant sees items, and the results of an item: entry i of the list comes i-th. The participant's number decides.
std::vector<int> OrderOfItems(int participant, int num_items);
std::vector<int> OrderOfResults(int participant, const StudyItem& item);

/// A study: shows each participant all items one by one, without the names of methods, and appends votes to a file. An item that a
/// participant voted on is not shown to this participant again. Thread-safe.
class Study {
 public:
  /// participant: absent: the number after the greatest among the votes. votes: made with the first vote. display: shows results that are
  /// bare faces of its template with eyes and teeth (DisplayHead::IsBareFace); null: all meshes are shown as they are. @throws Error as
  /// ReadStudyItems and ReadVotes; UsageError if the participant's number is not positive.
  Study(const std::filesystem::path& folder, std::filesystem::path votes, VoteKind kind,
        std::optional<int> participant = std::nullopt, std::unique_ptr<const DisplayHead> display = nullptr);

  /// {participant, done, total, kind: "best" or "ratings", questions: [name, ...], greatest: 1 or 5, item: {number, results: [{views}, ...]} or
  /// null, next: the same of the item after it}: results in the order in which they are shown, each with the names of its views.
  Json State();
  std::string SourcePicture(int item) const;  ///< The bytes of the file. @throws NotFound.
  /// A PNG or JPEG of the result at a place (from 1) from "front" or "turned"; results that are pictures have "front" alone. @throws NotFound.
  std::string ResultPicture(int item, int place, const std::string& view);
  /// Appends the votes {item: number, seconds, votes: [{place, question, value}, ...]} and returns the state: of `best` one vote, of
  /// ratings one a question and place. @throws UsageError naming what is missing or wrong; nothing is written then.
  Json Keep(const Json& body);
  /// The next participant begins. Returns the state.
  Json NextParticipant();

  /// Its calls. Valid while it exists.
  const std::vector<Route>& routes() const { return routes_; }

 private:
  void Begin(int participant);
  std::vector<int> Left() const;  ///< Items that the participant has not voted on, in their order.
  Json Describe(int item) const;
  Json StateNow() const;
  std::vector<std::string> Questions() const;
  const StudyItem& ItemAt(int item) const;
  void AddRoutes();

  const std::vector<StudyItem> items_;
  const std::filesystem::path votes_;
  const VoteKind kind_;
  const std::unique_ptr<const DisplayHead> display_;
  mutable std::mutex mutex_;  ///< Of the participant and what is done.
  int participant_ = 0;
  std::set<std::string> done_;
  std::mutex picture_mutex_;
  std::map<std::tuple<int, std::string, std::string>, std::string> pictures_;  ///< By item, method and view.
  std::vector<Route> routes_;
};

}  // namespace daumier::studio
