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

TEST(CameraJson, RefusesWhatItDoesNotTell) {
  testing::ExpectError([] { CameraToJson(WithPerspective(FrontalCamera({0, 0, 0}, 10, 64), 50)); }, "perspective");
  Json json = CameraToJson(FrontalCamera({0, 0, 0}, 10, 64));
  json["translation"] = {1, 2};
  testing::ExpectError([&] { CameraFromJson(json); }, "translation has 2 numbers, expected 3");
  json.erase("translation");
  EXPECT_THROW(CameraFromJson(json), Json::exception);
}

}  // namespace
}  // namespace daumier::render
