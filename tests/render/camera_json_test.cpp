#include "render/camera_json.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

TEST(CameraJson, GivesTheCameraBack) {
  const Camera camera = TurnedCamera({1, 2, 3}, 12.5, 256, 30, -10);
  const Camera again = CameraFromJson(CameraToJson(camera));
  EXPECT_EQ(again.camera_from_world, camera.camera_from_world);
  EXPECT_EQ(again.translation, camera.translation);
  EXPECT_EQ(again.scale, camera.scale);
  EXPECT_EQ(again.principal_point, camera.principal_point);
  EXPECT_EQ(again.width, 256);
  EXPECT_EQ(again.height, 256);
}

TEST(CameraJson, GivesACameraInPerspectiveBack) {
  const Camera camera = WithPerspective(TurnedCamera({1, 2, 3}, 12.5, 256, 30, -10), 60);
  const Json json = CameraToJson(camera);
  EXPECT_FALSE(json.contains("scale")) << "a reader of orthographic cameras has to refuse it";
  const Camera again = CameraFromJson(Json::parse(json.dump()));
  EXPECT_TRUE(again.perspective);
  EXPECT_EQ(again.scale, camera.scale);
  EXPECT_EQ(again.translation, camera.translation);
  const geometry::Points points = 5 * geometry::Points::Random(20, 3);
  EXPECT_EQ(Project(again, points), Project(camera, points));
}

TEST(CameraJson, ReadsAndWritesTheJsonOfManifestsBeforePerspective) {
  const Json old = Json::parse(
      R"({"camera_from_world":[1.0,0.0,0.0,0.0,-1.0,0.0,0.0,0.0,-1.0],"translation":[-1.0,2.0,3.0],"scale":12.5,)"
      R"("principal_point":[128.0,120.0],"width":256,"height":240})");
  const Camera camera = CameraFromJson(old);
  EXPECT_FALSE(camera.perspective);
  EXPECT_EQ(camera.scale, 12.5);
  EXPECT_EQ(CameraToJson(camera).dump(), old.dump());
}

TEST(CameraJson, RefusesMissingAndImpossibleNumbers) {
  Json json = CameraToJson(FrontalCamera({0, 0, 0}, 10, 64));
  json["translation"] = {1, 2};
  testing::ExpectError([&] { CameraFromJson(json); }, "translation has 2 numbers, expected 3");
  json.erase("translation");
  EXPECT_THROW(CameraFromJson(json), Json::exception);
  json = CameraToJson(WithPerspective(FrontalCamera({0, 0, 0}, 10, 64), 50));
  json["focal_length"] = 0;
  testing::ExpectError([&] { CameraFromJson(json); }, "focal_length is 0, expected a positive number");
  json.erase("focal_length");
  EXPECT_THROW(CameraFromJson(json), Json::exception);
}

}  // namespace
}  // namespace daumier::render
