#include "cli/edit_faces.h"

#include "cli/verb.h"
#include "core/error.h"
#include "core/log.h"
#include "core/process_task.h"
#include "core/random.h"
#include "core/stopwatch.h"
#include "fitting/code_directions.h"
#include "fitting/code_handles.h"
#include "fitting/surface_point_model.h"
#include "geometry/arap.h"
#include "systems/deform/edit_points.h"
#include "systems/deform/labelled_faces.h"
#include "systems/deform/latent_direction.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

/// Directions of labels, from faces that carry them.
class Labels {
 public:
  Labels(const deform::OpenedModel& opened, const EditArguments& arguments)
      : method_(arguments.label_method == "svm" ? fitting::DirectionMethod::kSvm : fitting::DirectionMethod::kMeans) {
    const fs::path folder = arguments.labelled_faces.empty() ? opened.faces : arguments.labelled_faces;
    if (folder.empty())
      throw UsageError(fmt::format(
          "labels come from faces, and the model '{}' names none: add --labelled FOLDER, a folder of faces of its "
          "topology (daumier dataset faces --config configs/faces/caricature.toml --out FOLDER)",
          opened.name));
    const faces::FaceDatabase database(folder);
    if (!arguments.label_file.empty()) {
      faces_ = deform::LabelledByFile(opened, database, arguments.label_file, TaskOfProcess());
      return;
    }
    deform::LabelledDatabase labelled = deform::LabelledFaces(opened, database, kMostFaces, TaskOfProcess());
    faces_ = std::move(labelled.faces);
    regular_mean_ = std::move(labelled.regular_mean);
  }

  const std::vector<std::string>& names() const { return faces_.names; }
  fitting::CodeDirection Of(const std::string& name) const { return fitting::DirectionOf(faces_, name, method_); }
  /// What faces are exaggerated from; empty with labels of a file.
  const Eigen::VectorXd& regular_mean() const { return regular_mean_; }

 private:
  static constexpr int kMostFaces = 1200;
  fitting::DirectionMethod method_;
  fitting::LabelledCodes faces_;
  Eigen::VectorXd regular_mean_;
};

/// Faces after the first one, one a step of each kind of edit.
class EditFaces {
 public:
  EditFaces(const deform::OpenedModel& opened, const EditArguments& arguments)
      : opened_(opened), arguments_(arguments), model_(*opened.model) {
    EditStart start = StartOf(arguments.start, model_);
    if (arguments.is_textured) texture_ = TextureOf(arguments.start, start, model_, arguments.texture_size);
    pictures_ = std::move(start.pictures);
    faces_.push_back(std::move(start.face));
  }

  void AddAll() {
    if (arguments_.random > 0) AddRandom();
    if (!arguments_.toward.empty()) AddInterpolation();
    if (!arguments_.labels.empty()) AddLabels();
    if (arguments_.caricature) AddCaricatures();
    if (!arguments_.handles.empty()) AddHandles();
    EditedFace& first = faces_.front();
    const auto has_its_name = [&](const EditedFace& face) { return face.name == first.name; };
    if (std::ranges::count_if(faces_, has_its_name) > 1) first.name = "start";  // A face of an earlier edit.
    constraints_["start"] = first.name;
  }

  EditContent Take() && {
    EditContent content;
    content.pictures = std::move(pictures_);
    content.faces = std::move(faces_);
    content.constraints = std::move(constraints_);
    content.texture = std::move(texture_);
    return content;
  }

 private:
  double ShareOf(int step) const { return double(step) / arguments_.steps; }

  EditedFace& Add(std::string name, std::string caption, const Eigen::VectorXd& code, Json record) {
    faces_.push_back({std::move(name), std::move(caption), code, model_.Vertices(code), std::move(record)});
    return faces_.back();
  }
  const Eigen::VectorXd& start() const { return faces_.front().code; }

  void AddRandom() {
    constraints_["random"] = {{"count", arguments_.random}, {"seed", arguments_.seed}, {"spread", arguments_.spread}};
    for (int i = 0; i < arguments_.random; ++i) {
      Rng rng = Stream(arguments_.seed, "edit samples", uint64_t(i));
      Eigen::VectorXd code(model_.num_numbers());
      for (double& number : code) number = arguments_.spread * rng.Normal();
      for (const int number : opened_.expression) code[number] = 0;  // Neutral faces.
      Add(fmt::format("random_{}", i + 1), fmt::format("random {}", i + 1), code, Json::object());
    }
  }

  void AddInterpolation() {
    const EditedFace end = FaceOf(arguments_.toward, {}, model_);
    constraints_["toward"] = end.record;
    for (int step = 1; step <= arguments_.steps; ++step) {
      const double share = ShareOf(step);
      Add(fmt::format("toward_{}", step), fmt::format("{:.0f} %", 100 * share),
          (1 - share) * start() + share * end.code, {{"share", share}});
    }
  }

  const Labels& AllLabels() {
    if (!labels_) labels_.emplace(opened_, arguments_);
    return *labels_;
  }

  Eigen::VectorXd StepOf(const std::string& label) {
    return deform::IsDirectionFile(label) ? deform::ReadLatentDirection(model_, label).step
                                          : AllLabels().Of(label).step;
  }

  void AddLabels() {
    std::vector<Eigen::VectorXd> kept;
    for (const std::string& name : arguments_.keep) kept.push_back(StepOf(name));
    Eigen::VectorXd step = Eigen::VectorXd::Zero(model_.num_numbers());
    std::string title;
    Json list = Json::array();
    for (const std::string& word : arguments_.labels) {
      const deform::LabelEdit edit = deform::ParseLabel(word);
      if (deform::IsDirectionFile(edit.name)) {
        const deform::LatentDirection direction = deform::ReadLatentDirection(model_, edit.name);
        step += edit.amount * fitting::Keeping(direction.step, kept);
        const std::string name = fs::path(edit.name).stem().string();
        title += (title.empty() ? "" : ", ") + name;
        list.push_back({{"label", name}, {"amount", edit.amount}, {"deviation", direction.deviation}});
        continue;
      }
      const fitting::CodeDirection direction = AllLabels().Of(edit.name);
      step += edit.amount * fitting::Keeping(direction.step, kept);
      title += (title.empty() ? "" : ", ") + edit.name;
      list.push_back({{"label", edit.name},
                      {"amount", edit.amount},
                      {"accuracy", direction.accuracy},
                      {"faces_without", direction.num_low},
                      {"faces_with", direction.num_high}});
    }
    constraints_["labels"] = {{"method", arguments_.label_method}, {"edits", list}, {"kept", arguments_.keep}};
    for (int i = 1; i <= arguments_.steps; ++i)
      Add(fmt::format("label_{}", i), fmt::format("{} {:.0f} %", title, 100 * ShareOf(i)), start() + ShareOf(i) * step,
          {{"share", ShareOf(i)}});
  }

  void AddCaricatures() {
    const double strength = *arguments_.caricature;
    constraints_["caricature"] = strength;
    const bool has_labels = !arguments_.labelled_faces.empty() || !opened_.faces.empty();
    Eigen::VectorXd deviation = start();
    if (has_labels && AllLabels().regular_mean().size() > 0) deviation -= AllLabels().regular_mean();
    for (const int number : opened_.expression) deviation[number] = 0;
    for (int i = 1; i <= arguments_.steps; ++i) {
      const double share = strength * ShareOf(i);
      Add(fmt::format("exaggerated_{}", i), fmt::format("exaggerated {:.2g}", share), start() + share * deviation,
          {{"strength", share}});
    }
    if (!has_labels) {
      log::Info(
          "Without labelled faces there is no direction of caricatures: the face is exaggerated from the mean alone");
      return;
    }
    if (std::ranges::count(AllLabels().names(), deform::kCaricatureLabel) == 0) return;
    const fitting::CodeDirection direction = AllLabels().Of(deform::kCaricatureLabel);
    for (int i = 1; i <= arguments_.steps; ++i) {
      const double share = strength * ShareOf(i);
      Add(fmt::format("class_{}", i), fmt::format("class {:.2g}", share), start() + share * direction.step,
          {{"strength", share}, {"accuracy", direction.accuracy}});
    }
  }

  void AddHandles() {
    const faces::FaceTemplate& face_template = model_.face_template();
    std::vector<deform::EditHandles> list;
    for (const std::string& word : arguments_.handles) list.push_back(deform::ParseHandle(face_template, word));
    const deform::EditHandles handles = deform::JoinHandles(list, face_template.num_vertices());
    const fitting::SurfacePointModel model(model_, handles.on_surface);
    fitting::HandleOptions options{.deviation_cm = arguments_.soft_cm};
    if (!arguments_.moves_expression) options.fixed = opened_.expression;
    if (arguments_.is_local) options.outside = deform::OutsideOfPart(face_template, handles);
    constraints_["handles"] = {{"words", arguments_.handles},
                               {"vertices", deform::VerticesOfHandles(face_template, handles)},
                               {"local", arguments_.is_local},
                               {"held", !arguments_.soft_cm.has_value()}};
    const EditedFace first = faces_.front();
    fitting::HandleEditor editor(model, first.code, handles.points, options);
    for (int i = 1; i <= arguments_.steps; ++i) {
      const Stopwatch watch;
      const fitting::HandleEdit edit = editor.MoveBy(ShareOf(i) * handles.displacements);
      const double seconds = watch.seconds();
      const std::string caption = fmt::format("handles {:.0f} %", 100 * ShareOf(i));
      Json record = {{"share", ShareOf(i)}, {"residual_share", edit.residual_share}, {"seconds", seconds}};
      if (arguments_.is_local) record["outside_share"] = edit.outside_share;
      Warn(edit, caption);
      Add(fmt::format("handles_{}", i), caption, edit.code, std::move(record));
    }
    if (arguments_.with_arap) AddArap(handles, first, options.outside);
  }

  void Warn(const fitting::HandleEdit& edit, const std::string& caption) const {
    if (!arguments_.soft_cm && edit.residual_share > fitting::kHeldShare)
      log::Warn("{}: the model has no face with the handles there; {:.0f} % of the move are missing", caption,
                100 * edit.residual_share);
  }

  void AddArap(const deform::EditHandles& handles, const EditedFace& first, std::vector<int> fixed) {
    const faces::FaceTemplate& face_template = model_.face_template();
    if (fixed.empty()) fixed = faces::RegionFor(face_template.annotation, "neck_border", "--arap");
    std::vector<int> ids;  // Of a point on a triangle the nearest corner.
    for (const std::vector<int>& vertices : deform::VerticesOfHandles(face_template, handles))
      ids.push_back(vertices.front());
    const auto num_handles = std::ssize(ids);
    std::erase_if(fixed, [&](int vertex) { return std::ranges::count(ids, vertex) > 0; });
    ids.insert(ids.end(), fixed.begin(), fixed.end());
    const geometry::ArapDeformer deformer({first.vertices, face_template.triangles}, ids);
    for (int i = 1; i <= arguments_.steps; ++i) {
      geometry::Points targets = first.vertices(ids, Eigen::all);
      targets.topRows(num_handles) += ShareOf(i) * handles.displacements;
      const geometry::ArapDeformation result = deformer.Solve(targets);
      faces_.push_back({fmt::format("arap_{}", i),
                        fmt::format("ARAP {:.0f} %", 100 * ShareOf(i)),
                        {},
                        result.vertices,
                        {{"share", ShareOf(i)}, {"energy", result.energies.back()}}});
    }
  }

  const deform::OpenedModel& opened_;
  const EditArguments& arguments_;
  const fitting::CodeModel& model_;
  std::vector<render::SheetCell> pictures_;
  std::optional<EditTexture> texture_;
  std::vector<EditedFace> faces_;
  Json constraints_ = Json::object();
  std::optional<Labels> labels_;
};

}  // namespace

EditContent MakeEdit(const deform::OpenedModel& opened, const EditArguments& arguments) {
  EditFaces edit(opened, arguments);
  edit.AddAll();
  return std::move(edit).Take();
}

std::vector<std::string> LabelNames(const deform::OpenedModel& opened, const EditArguments& arguments) {
  return Labels(opened, arguments).names();
}

}  // namespace daumier::cli
