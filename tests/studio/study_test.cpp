#include "studio/study.h"

#include "core/files.h"
#include "geometry/obj.h"
#include "render/image.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_model.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace daumier::studio {
namespace {

using testing::ExpectError;

/// Three items of three methods: a mesh of "flat" and "round", a picture of "plain".
class StudyTest : public ::testing::Test {
 protected:
  StudyTest() {
    const faces::FaceTemplate face_template = testing::SyntheticModel().face_template;
    const geometry::TriangleMesh mesh = faces::SurfaceMesh(face_template, face_template.neutral);
    for (const char* name : {"ann", "bob", "cid"}) {
      MakeDirectory(items_ / name);
      render::WriteImage(items_ / name / "source.png", render::Image(8, 8, 3, 200));
      render::WriteImage(items_ / name / "plain.png", render::Image(6, 6, 3, 90));
      geometry::WriteObj(items_ / name / "flat.obj", mesh);
      geometry::WriteObj(items_ / name / "round.obj", mesh);
    }
  }

  Study Open(VoteKind kind, std::optional<int> participant = 1) const {
    return Study(items_.path(), votes_, kind, participant);
  }
  static int ItemOf(const Json& state) { return state.at("item").at("number").get<int>(); }
  /// Each place gets its number as its rating of every question.
  static Json AllRatings(const Json& state) {
    Json votes = Json::array();
    for (int place = 1; place <= 3; ++place)
      for (const Json& question : state.at("questions"))
        votes.push_back({{"place", place}, {"question", question}, {"value", place + 1}});
    return {{"item", ItemOf(state)}, {"seconds", 4.25}, {"votes", votes}};
  }
  static Json Best(const Json& state, int place) {
    return {
        {"item", ItemOf(state)}, {"seconds", 1}, {"votes", {{{"place", place}, {"question", "best"}, {"value", 1}}}}};
  }

  const testing::TempDir items_, out_;
  const std::filesystem::path votes_ = out_ / "votes.csv";
};

TEST_F(StudyTest, BareFacesOfTheTemplateAreShownWithEyes) {
  const faces::FaceTemplate face_template = testing::SyntheticModel().face_template;
  Study bare = Open(VoteKind::kBest);
  Study shown(items_.path(), votes_, VoteKind::kBest, 1, std::make_unique<const DisplayHead>(face_template));
  const int item = ItemOf(bare.State());
  int num_finished = 0;
  for (int place = 1; place <= 3; ++place)
    num_finished += shown.ResultPicture(item, place, "front") != bare.ResultPicture(item, place, "front");
  EXPECT_EQ(num_finished, 2) << "two meshes, and a picture that stays";
}

TEST_F(StudyTest, ReadsItemsAndMethodsByName) {
  const std::vector<StudyItem> items = ReadStudyItems(items_.path());
  ASSERT_EQ(items.size(), 3u);
  EXPECT_EQ(items[1].name, "bob");
  ASSERT_EQ(items[1].results.size(), 3u);
  EXPECT_EQ(items[1].results[0].method, "flat");
  EXPECT_TRUE(items[1].results[0].is_mesh);
  EXPECT_EQ(items[1].results[1].method, "plain");
  EXPECT_FALSE(items[1].results[1].is_mesh);
}

TEST_F(StudyTest, SaysWhatAnItemLacks) {
  std::filesystem::remove(items_ / "bob/source.png");
  ExpectError([&] { ReadStudyItems(items_.path()); }, "bob: there is no source.png");
  render::WriteImage(items_ / "bob/source.jpg", render::Image(8, 8, 3));
  render::WriteImage(items_ / "bob/flat.png", render::Image(8, 8, 3));
  ExpectError([&] { ReadStudyItems(items_.path()); }, "two files of the method flat");
  for (const char* file : {"bob/flat.png", "bob/flat.obj", "bob/round.obj"}) std::filesystem::remove(items_ / file);
  ExpectError([&] { ReadStudyItems(items_.path()); }, "results of 1 methods");
  ExpectError([&] { ReadStudyItems(out_.path()); }, "there is no folder in it");
}

TEST_F(StudyTest, OrdersAreThoseOfTheParticipantAndBalanced) {
  const std::vector<StudyItem> items = ReadStudyItems(items_.path());
  EXPECT_EQ(OrderOfItems(5, 20), OrderOfItems(5, 20));
  EXPECT_NE(OrderOfItems(5, 20), OrderOfItems(6, 20));
  std::array<int, 3> first{};
  std::set<std::vector<int>> orders;
  for (int participant = 1; participant <= 300; ++participant) {
    const std::vector<int> order = OrderOfResults(participant, items[0]);
    ++first[size_t(order[0])];
    orders.insert(order);
  }
  EXPECT_EQ(orders.size(), 6u);
  for (const int count : first) EXPECT_NEAR(count, 100, 35);
}

TEST_F(StudyTest, RatingsAreWrittenByMethodAndPlace) {
  Study study = Open(VoteKind::kRatings);
  const Json state = study.State();
  EXPECT_EQ(state.at("questions"), Json({"aesthetics", "accuracy", "similarity"}));
  EXPECT_EQ(state.at("greatest"), 5);
  const int item = ItemOf(state);
  const Json next = study.Keep(AllRatings(state));
  EXPECT_EQ(next.at("done"), 1);
  EXPECT_EQ(next.at("item"), state.at("next"));
  const StudyItem shown = ReadStudyItems(items_.path())[size_t(item)];
  const std::vector<int> order = OrderOfResults(1, shown);
  const std::vector<Vote> votes = ReadVotes(votes_);
  ASSERT_EQ(votes.size(), 9u);
  for (const Vote& vote : votes) {
    EXPECT_EQ(vote.participant, "1");
    EXPECT_EQ(vote.item, shown.name);
    EXPECT_EQ(vote.method, shown.results[size_t(order[size_t(vote.place - 1)])].method);
    EXPECT_EQ(vote.value, vote.place + 1);
    EXPECT_EQ(vote.seconds, 4.25);
  }
}

TEST_F(StudyTest, TheBestGetsOneAndTheOthersNothing) {
  Study study = Open(VoteKind::kBest);
  const Json state = study.State();
  study.Keep(Best(state, 2));
  const std::vector<Vote> votes = ReadVotes(votes_);
  ASSERT_EQ(votes.size(), 3u);
  for (const Vote& vote : votes) EXPECT_EQ(vote.value, vote.place == 2 ? 1 : 0);
}

TEST_F(StudyTest, WrongVotesWriteNothing) {
  Study study = Open(VoteKind::kRatings);
  const Json good = AllRatings(study.State());
  const auto refused = [&](const char* place, const Json& value, const std::string& cause) {
    Json bad = good;
    bad[Json::json_pointer(place)] = value;
    ExpectError([&] { study.Keep(bad); }, cause);
  };
  refused("/item", ItemOf(study.State()) + 1, "not the one that is shown");
  refused("/votes/0/place", 4, "'place' is 4, expected 1 to 3");
  refused("/votes/0/question", "beauty", "expected aesthetics, accuracy, similarity");
  refused("/votes/0/value", 6, "'value' is 6, expected 1 to 5");
  refused("/votes/0/value", 2.5, "'value' is 2.5");
  refused("/votes/0/place", 2, "8 votes, expected 9");
  refused("/votes", Json::array(), "0 votes, expected 9");
  refused("/seconds", "2", "'seconds' is no number");
  EXPECT_FALSE(std::filesystem::exists(votes_));
  EXPECT_EQ(study.State().at("done"), 0);
}

TEST_F(StudyTest, AParticipantGoesOnAndTheNextOneHasTheNextNumber) {
  {
    Study study = Open(VoteKind::kBest, 4);
    study.Keep(Best(study.State(), 1));
  }
  Study again = Open(VoteKind::kBest, 4);
  EXPECT_EQ(again.State().at("done"), 1);
  again.Keep(Best(again.State(), 1));
  again.Keep(Best(again.State(), 3));
  EXPECT_TRUE(again.State().at("item").is_null());
  EXPECT_TRUE(again.State().at("next").is_null());
  const Json next = again.NextParticipant();
  EXPECT_EQ(next.at("participant"), 5);
  EXPECT_EQ(next.at("done"), 0);
  EXPECT_EQ(Open(VoteKind::kBest, std::nullopt).State().at("participant"), 5) << "nobody voted as 5";
  ExpectError([&] { Open(VoteKind::kBest, 0); }, "the participant's number is 0");
}

TEST_F(StudyTest, RoutesHideTheNamesOfMethods) {
  Study study = Open(VoteKind::kRatings);
  const auto get = [&](const std::string& path) { return Call(study.routes(), "GET", path, {}); };
  EXPECT_EQ(Json::parse(get("/api/info").body).at("mode"), "study");
  const std::string state = get("/api/study").body;
  for (const char* name : {"flat", "round", "plain", "ann", "bob", "cid"})
    EXPECT_EQ(state.find(name), std::string::npos) << name;
  const Json results = Json::parse(state).at("item").at("results");
  const std::string item = fmt::format("/api/study/items/{}", ItemOf(study.State()));
  EXPECT_EQ(render::DecodeImage(get(item + "/source").body, "source").width, 8);
  for (int place = 1; place <= 3; ++place) {
    const std::string path = fmt::format("{}/results/{}/", item, place);
    const bool is_mesh = results[size_t(place - 1)].at("views").size() == 2;
    const ApiReply front = get(path + "front"), turned = get(path + "turned");
    EXPECT_EQ(front.type, "image/png");
    EXPECT_EQ(render::DecodeImage(front.body, "front").width == 6, !is_mesh);
    EXPECT_EQ(turned.status, is_mesh ? 200 : 404);
    EXPECT_NE(front.body, turned.body);
  }
  EXPECT_EQ(get(item + "/results/4/front").status, 404);
  EXPECT_EQ(get("/api/study/items/9/source").status, 404);
  EXPECT_EQ(get("/api/study/items/-1/source").status, 404);
  EXPECT_EQ(Call(study.routes(), "POST", "/api/study/votes", {.path = {}, .query = {}, .body = "[]"}).status, 400);
}

}  // namespace
}  // namespace daumier::studio
