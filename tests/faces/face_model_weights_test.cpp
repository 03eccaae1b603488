#include "faces/face_model_weights.h"

#include "core/error.h"
#include "core/files.h"
#include "core/weights_folder.h"
#include "faces/appearance/albedo_basis.h"
#include "faces/face_model_file.h"
#include "faces/source.h"
#include "tests/faces/same_model.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_model.h"
#include "tests/support/temp_dir.h"

namespace daumier::faces {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;
using testing::ExpectSameModel;

TEST(FaceModelWeights, TakeThePlaceOfTheirSource) {
  const testing::TempDir folder;
  FaceModel model = testing::SyntheticModel();
  model.face_template.source = "ict";
  model.face_template.provenance = {{"name", "Faces"}, {"version", "1"}, {"licence", "MIT, (c) 2020 A University"}};
  const Json details = WriteFaceModelWeights(folder / "face-ict", model);
  EXPECT_LT(details.at("largest_error_mm").at("identity").get<double>(), 0.01);
  EXPECT_GT(details.at("largest_error_mm").at("identity").get<double>(), 1e-5);

  const FaceModel read = LoadFaceModel({.name = "ict", .path = (folder / "face-ict").string()});
  ExpectSameModel(read, model);
  const ModelDifference difference = DifferenceOf(read, model);
  EXPECT_NEAR(details.at("largest_error_mm").at("identity").get<double>(),
              MillimetresPerCm(model.face_template) * difference.identity_cm, 1e-9);
  EXPECT_EQ(read.face_template.provenance.at("licence"), "MIT, (c) 2020 A University");
  EXPECT_EQ(read.face_template.provenance.at("shapes"), "rounded to 0.005 mm");
  const std::string card = ReadFile(folder / "face-ict" / kWeightsCard);
  EXPECT_NE(card.find("Copyright (c) 2020 A University"), std::string::npos);
  ExpectError([&] { LoadFaceModel({.name = "makehuman", .path = (folder / "face-ict").string()}); },
              "is a face model of the source 'ict' (expected 'makehuman'). Set source.name=ict");
}

TEST(FaceModelWeights, EqualModelsGiveEqualBytesAndReplaceEarlierOnes) {
  const testing::TempDir folder;
  FaceModel model = testing::SyntheticModel();
  WriteFaceModelWeights(folder / "face", model);
  const std::string hash = DataHash(folder / "face");
  WriteFaceModelWeights(folder / "face", model);
  EXPECT_EQ(DataHash(folder / "face"), hash);
  model.identity_shapes *= 0.9F;
  WriteFaceModelWeights(folder / "face", model);
  EXPECT_NE(DataHash(folder / "face"), hash);
  WriteFileAtomically(folder / "face/notes.txt", "precious");
  EXPECT_THROW(WriteFaceModelWeights(folder / "face", model), UsageError);
  EXPECT_EQ(ReadFile(folder / "face/notes.txt"), "precious");
}

TEST(FaceModelWeights, AChangedFileIsNamed) {
  const testing::TempDir folder;
  WriteFaceModelWeights(folder / "face", testing::SyntheticModel());
  for (const char* file : {kModelShapes, kModelText, "template.safetensors", "template.json", kWeightsCard}) {
    const std::string bytes = ReadFile(folder / "face" / file);
    std::string damaged = bytes;
    damaged[damaged.size() / 2] ^= 1;
    WriteFileAtomically(folder / "face" / file, damaged);
    ExpectError([&] { ReadFaceModelWeights(folder / "face"); }, std::string(file) + " has changed");
    WriteFileAtomically(folder / "face" / file, bytes);
  }
  EXPECT_NO_THROW(ReadFaceModelWeights(folder / "face"));
}

/// The source of the shipped weights, where it is there.
TEST(FaceModelWeights, OfIctAreSmallAndWithinAHundredthOfAMillimetre) {
  const auto shared = testing::SharedData();
  if (!shared || !fs::exists(*shared / "ict-facekit.tar.xz"))
    GTEST_SKIP() << "ict-facekit.tar.xz is not there; set DAUMIER_SHARED_DATA";
  const testing::TempDir folder;
  const FaceModel model = LoadFaceModel({.name = "ict", .path = (*shared / "ict-facekit.tar.xz").string()});
  const Json details = WriteFaceModelWeights(folder / "face-ict", model);
  EXPECT_LT(details.at("largest_error_mm").at("identity").get<double>(), 0.01) << details;
  EXPECT_LT(details.at("largest_error_mm").at("expression").get<double>(), 0.01) << details;
  uintmax_t num_bytes = 0;
  for (const auto& entry : fs::directory_iterator(folder / "face-ict")) num_bytes += entry.file_size();
  EXPECT_LT(num_bytes, 9'000'000U);

  const FaceModel read = LoadFaceModel({.name = "ict", .path = (folder / "face-ict").string()});
  ExpectSameModel(read, model);
  EXPECT_TRUE(MakeAlbedoBasis(read.face_template).modes == MakeAlbedoBasis(model.face_template).modes);
  // A whole face, not a shape alone.
  Rng rng(5), same(5);
  const double scale = MillimetresPerCm(model.face_template);
  for (int i = 0; i < 20; ++i) {
    const geometry::Points difference =
        IdentityFace(read, DrawIdentity(read, rng)) - IdentityFace(model, DrawIdentity(model, same));
    EXPECT_LT(scale * difference.rowwise().norm().maxCoeff(), 0.1);
  }
}

}  // namespace
}  // namespace daumier::faces
