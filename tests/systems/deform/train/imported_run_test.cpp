#include "core/files.h"
#include "datasets/build/given_faces.h"
#include "faces/import/mesh_folder.h"
#include "faces/import/torch_file.h"
#include "systems/deform/import_authors_model.h"
#include "systems/deform/metrics.h"
#include "systems/deform/open_code_model.h"
#include "systems/deform/train/evaluation.h"
#include "systems/deform/train/export.h"
#include "systems/deform/train/run.h"
#include "tensor/eigen.h"
#include "tests/support/authors_model.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <torch/serialize.h>

namespace daumier::deform {
namespace {

namespace fs = std::filesystem;

torch::Tensor TensorOf(const NamedArrays& state, const std::string& name) {
  const FloatArray& array = state.at(name);
  return torch::tensor(array.values).reshape(array.shape);
}

/// The positions of codes (B, M) by LibTorch's operators over the authors' names, (B, N, 3).
torch::Tensor AuthorsForward(const NamedArrays& state, const torch::Tensor& codes, const torch::Tensor& points) {
  const auto made = [&](int branch) {
    torch::Tensor x = codes;
    for (int i = 0; i < 3; ++i) {
      const std::string name = fmt::format("hyper_net.nets.{}.net.{}.0.", branch, i);
      x = torch::addmm(TensorOf(state, name + "bias"), x, TensorOf(state, name + "weight").t());
      if (i < 2) x = torch::relu(x);
    }
    return x;
  };
  torch::Tensor x = points.unsqueeze(0);
  for (int layer = 0; layer < 5; ++layer) {
    const torch::Tensor bias = made(2 * layer + 1).unsqueeze(1);
    const torch::Tensor weight = made(2 * layer).reshape({codes.size(0), bias.size(2), x.size(2)});
    x = torch::matmul(x, weight.transpose(1, 2)) + bias;
    if (layer < 4) x = torch::sin(30 * x);
  }
  return points + x;
}

class ImportedRun : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<testing::TempDir>();
    state_ = testing::WriteAuthorsFiles(folder_->path());
    ImportAuthorsModel({In("checkpoint.pth"), In("template.obj"), In("template.json"), ""}, In("run"));
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static fs::path In(const char* name) { return *folder_ / name; }

  /// A database of the faces of the first training codes.
  static void BuildItsFaces(int count) {
    const DeformRun run = LoadDeformRun(In("run"));
    MakeDirectory(In("meshes"));
    for (int i = 0; i < count; ++i) {
      const torch::Tensor vertices = run.network->DeformVertices(run.codes.narrow(0, i, 1))[0];
      geometry::WriteObj(In("meshes") / fmt::format("{}.obj", i),
                         geometry::TriangleMesh{tensor::CopyToMatrix<double>(vertices), run.face_template.triangles});
    }
    const auto annotation = faces::ParseAnnotationFile(ReadFile(In("template.json")), "template.json");
    datasets::FacesOptions options;
    options.exaggeration.gammas = {0.0};
    datasets::BuildGivenFaces(faces::LoadMeshFolder(In("meshes"), annotation, faces::PersonOf::kFile, "CC0"), options,
                              In("faces"));
  }

  inline static std::unique_ptr<testing::TempDir> folder_;
  inline static NamedArrays state_;
};

TEST_F(ImportedRun, BothNetworksAreTheAuthorsFunction) {
  const DeformRun run = LoadDeformRun(In("run"));
  const torch::Tensor truth = AuthorsForward(state_, run.codes, run.network->template_vertices());
  const double largest = truth.abs().max().item<double>();
  EXPECT_GT((truth - run.network->template_vertices()).abs().max().item<double>(), 0.02) << "it moves points";
  EXPECT_LT((run.network->DeformVertices(run.codes) - truth).abs().max().item<double>(), 1e-5 * largest);
  const OpenedModel opened = OpenCodeModel(In("run"));
  const Eigen::VectorXd code = Eigen::VectorXd::LinSpaced(opened.model->num_numbers(), 1, -1);
  const Eigen::VectorXd latent = opened.model->Latent(code);
  const torch::Tensor codes = tensor::CopyToTensor(latent).to(torch::kFloat32).reshape({1, -1});
  const geometry::Points expected =
      10 * tensor::CopyToMatrix<double>(AuthorsForward(state_, codes, run.network->template_vertices())[0]);
  EXPECT_LT((opened.model->Vertices(code) - expected).cwiseAbs().maxCoeff(), 1e-5 * expected.cwiseAbs().maxCoeff());
}

TEST_F(ImportedRun, WhatLibTorchPicklesIsReadBack) {
  c10::Dict<std::string, torch::Tensor> dictionary;
  for (const auto& item : state_) dictionary.insert(item.first, TensorOf(state_, item.first));
  dictionary.insert("part", torch::arange(12.0).reshape({3, 4}).t().slice(0, 1, 3));
  const std::vector<char> bytes = torch::pickle_save(dictionary);
  testing::WriteQuickly(In("pickled.pth"), {bytes.data(), bytes.size()});
  const NamedArrays read = faces::ReadTorchState(In("pickled.pth"));
  ASSERT_EQ(read.size(), state_.size() + 1);
  for (const auto& [name, array] : state_) EXPECT_EQ(read.at(name).values, array.values) << name;
  EXPECT_EQ(read.at("part").values, (std::vector<float>{1, 5, 9, 2, 6, 10}));
}

TEST_F(ImportedRun, IsMeasuredOnOtherFacesAgainstTheTemplate) {
  BuildItsFaces(3);
  FolderCache databases;
  const reports::Evaluation evaluation =
      EvaluateDeformRun(In("run"), {.faces = In("faces").string(), .max_faces = 3}, databases);
  const Json& rows = evaluation.metrics.at("table");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].at("name"), kTemplate);
  EXPECT_GT(rows[1].at("error").get<double>(), 0.01);
  // Faces of the model are found again, but for the weight of the code.
  EXPECT_LT(rows[0].at("error").get<double>(), 0.5 * rows[1].at("error").get<double>());
  testing::ExpectError([&] { EvaluateDeformRun(In("run"), {}, databases); },
                       "was imported, and has no faces of its own: name registered faces of its topology by --faces");
}

TEST_F(ImportedRun, IsDescribedForExport) {
  const exporting::RunExport description = DescribeDeformExport(In("run"));
  EXPECT_EQ(description.counts.at("vertices"), testing::SyntheticFace().num_vertices());
}

}  // namespace
}  // namespace daumier::deform
