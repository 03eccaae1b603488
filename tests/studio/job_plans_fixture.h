#pragma once
#include "core/files.h"
#include "render/image.h"
#include "studio/display_head.h"
#include "studio/job_plans.h"
#include "tests/studio/shipped_studio.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace daumier::studio {

/// With the shipped weights, and a program that is not there: what a job writes before it starts the program is in its folder.
class JobPlansTest : public ::testing::Test {
 protected:
  const JobMaterial& material() const { return material_; }
  NewJob Plan(const Json& body) const { return PlanJob(body, material_); }
  std::string CommandOf(const Json& body) const { return Plan(body).command; }
  std::string Upload(const std::string& name) {
    const bool is_png = name.ends_with(".png"), is_picture = is_png || name.ends_with(".jpg");
    const auto format = is_png ? render::ImageFormat::kPng : render::ImageFormat::kJpeg;
    return uploads_.Add(name,
                        is_picture ? render::EncodeImage(render::Image(32, 32, 3, 90), format) : "bytes of it")["id"];
  }
  std::string Pinned() { return tray_.Pin("Ada", Mean(), Json()); }
  std::string MeanSession() { return desk_.Add({.begins_with_mean = true}); }
  std::string DrawnSession() {
    const std::string id = desk_.Add({});
    desk_.Do(id, {{"do", "draw"}, {"points", {{20, 20}, {30, 25}}}});
    return id;
  }
  static const geometry::Points& Mean() { return testing::ShippedShaper().face_template().neutral; }
  void ExpectRefused(const Json& body, const std::string& why) const {
    testing::ExpectError([&] { Plan(body); }, why);
    EXPECT_THROW(Plan(body), UsageError) << body;
  }
  /// The folder of a job that has tried to start the program.
  std::filesystem::path Written(const Json& body) const {
    MakeDirectory(folder_ / "job" / kJobScratch);
    testing::ExpectError([&] { Plan(body).work(folder_ / "job", Task()); },
                         "daumier is not there any more. Start the studio again");
    return folder_ / "job";
  }

  const testing::TempDir folder_;
  SketchDesk desk_{folder_ / "sessions", testing::ShippedSketchPredictor(), nullptr};
  static const DisplayHead& Display() {
    static const DisplayHead display(testing::ShippedShaper().face_template());
    return display;
  }
  FaceTray tray_{folder_ / "faces", testing::ShippedSketchPredictor()->face_template(), Display()};
  Uploads uploads_{folder_ / "uploads"};
  const JobMaterial material_{desk_, tray_, testing::ShippedShaper(), uploads_, Display(), testing::kNoProgram};
};

}  // namespace daumier::studio
