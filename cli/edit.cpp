#include "cli/edit_files.h"
#include "cli/edit_start.h"
#include "cli/verb.h"
#include "core/error.h"
#include "core/log.h"
#include "core/output_place.h"
#include "core/process_task.h"
#include "core/random.h"
#include "core/stopwatch.h"
#include "fitting/code_directions.h"
#include "fitting/code_handles.h"
#include "geometry/arap.h"
#include "systems/deform/edit_points.h"
#include "systems/deform/labelled_faces.h"
#include "systems/deform/open_code_model.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

struct EditArguments {
  fs::path model, out, toward, labelled_faces, label_file;
  EditStartArguments start;
  std::vector<std::string> handles, labels, keep;
  std::optional<double> soft_cm, caricature;
  double spread = 0.5;
  int random = 0, steps = 3;
  uint64_t seed = 1;
  bool is_local = false, with_arap = false, moves_expression = false, writes_ply = false, lists_labels = false,
       as_json = false;
};

/// Directions of labels, from faces that carry them.
class Labels {
 public:
  Labels(const deform::OpenedModel& opened, const EditArguments& arguments) {
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
  fitting::CodeDirection Of(const std::string& name) const { return fitting::DirectionOf(faces_, name); }
  /// What faces are exaggerated from; empty with labels of a file.
  const Eigen::VectorXd& regular_mean() const { return regular_mean_; }

 private:
  static constexpr int kMostFaces = 1200;
  fitting::LabelledCodes faces_;
  Eigen::VectorXd regular_mean_;
};

/// Faces after the first one, one a step of each kind of edit.
class EditFaces {
 public:
  EditFaces(const deform::OpenedModel& opened, const EditArguments& arguments)
      : opened_(opened), arguments_(arguments), model_(*opened.model) {
    EditStart start = StartOf(arguments.start, model_);
    pictures_ = std::move(start.pictures);
    faces_.push_back(std::move(start.face));
    constraints_["start"] = faces_.front().name;
  }

  void AddAll() {
    if (arguments_.random > 0) AddRandom();
    if (!arguments_.toward.empty()) AddInterpolation();
    if (!arguments_.labels.empty()) AddLabels();
    if (arguments_.caricature) AddCaricatures();
    if (!arguments_.handles.empty()) AddHandles();
  }

  EditContent Take() && {
    EditContent content;
    content.pictures = std::move(pictures_);
    content.faces = std::move(faces_);
    content.constraints = std::move(constraints_);
    return content;
  }
  std::vector<EditedFace>& faces() { return faces_; }

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

  void AddLabels() {
    std::vector<Eigen::VectorXd> kept;
    for (const std::string& name : arguments_.keep) kept.push_back(AllLabels().Of(name).step);
    Eigen::VectorXd step = Eigen::VectorXd::Zero(model_.num_numbers());
    std::string title;
    Json list = Json::array();
    for (const std::string& word : arguments_.labels) {
      const deform::LabelEdit edit = deform::ParseLabel(word);
      const fitting::CodeDirection direction = AllLabels().Of(edit.name);
      step += edit.amount * fitting::Keeping(direction.step, kept);
      title += (title.empty() ? "" : ", ") + edit.name;
      list.push_back({{"label", edit.name},
                      {"amount", edit.amount},
                      {"accuracy", direction.accuracy},
                      {"faces_without", direction.num_low},
                      {"faces_with", direction.num_high}});
    }
    constraints_["labels"] = {{"edits", list}, {"kept", arguments_.keep}};
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
    const deform::EditHandles handles = deform::JoinHandles(list);
    fitting::HandleOptions options{.deviation_cm = arguments_.soft_cm};
    if (!arguments_.moves_expression) options.fixed = opened_.expression;
    if (arguments_.is_local) options.outside = deform::OutsideOfPart(face_template, handles.vertices);
    constraints_["handles"] = {{"words", arguments_.handles},
                               {"vertices", handles.vertices},
                               {"local", arguments_.is_local},
                               {"held", !arguments_.soft_cm.has_value()}};
    const EditedFace first = faces_.front();
    fitting::HandleEditor editor(model_, first.code, handles.vertices, options);
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
    if (!edit.is_usual)
      log::Warn(
          "{}: the face is unlike those that the model was made of: its code is {:.1f} long, 99 % of theirs are below "
          "{:.1f}. Move the handles less, or drop --local",
          caption, edit.code.norm(), model_.usual_radius());
  }

  void AddArap(const deform::EditHandles& handles, const EditedFace& first, std::vector<int> fixed) {
    const faces::FaceTemplate& face_template = model_.face_template();
    if (fixed.empty()) fixed = faces::RegionFor(face_template.annotation, "neck_border", "--arap");
    std::erase_if(fixed, [&](int vertex) { return std::ranges::count(handles.vertices, vertex) > 0; });
    std::vector<int> ids = handles.vertices;
    ids.insert(ids.end(), fixed.begin(), fixed.end());
    const geometry::ArapDeformer deformer({first.vertices, face_template.triangles}, ids);
    for (int i = 1; i <= arguments_.steps; ++i) {
      geometry::Points targets = first.vertices(ids, Eigen::all);
      targets.topRows(std::ssize(handles.vertices)) += ShareOf(i) * handles.displacements;
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
  std::vector<EditedFace> faces_;
  Json constraints_ = Json::object();
  std::optional<Labels> labels_;
};

/// A result for people: its faces by name, with their numbers and words, but without lists.
Json ByName(Json result) {
  Json faces = Json::object();
  for (const Json& face : result["faces"]) {
    Json& row = faces[face["name"].get<std::string>()] = Json::object();
    for (const auto& [key, value] : face.items())
      if (key != "name" && value.is_primitive()) row[key] = value;
  }
  result["faces"] = std::move(faces);
  return result;
}

/// Files and folders that the edit reads.
std::vector<fs::path> InputsOf(const EditArguments& arguments, const fs::path& model) {
  const EditStartArguments& start = arguments.start;
  std::vector<fs::path> inputs = {model,         start.face,       start.mesh_landmarks,     start.landmarks,
                                  start.picture, arguments.toward, arguments.labelled_faces, arguments.label_file};
  if (!start.code.empty()) inputs.push_back(FileOfCode(start.code).file);
  std::erase_if(inputs, [](const fs::path& path) { return path.empty(); });
  return inputs;
}

void Edit(const EditArguments& arguments) {
  const Stopwatch watch;
  const fs::path folder = arguments.model.empty() ? deform::ShippedModel() : arguments.model;
  if (arguments.lists_labels) {
    const deform::OpenedModel opened = deform::OpenCodeModel(folder);
    PrintResult({{"labels", Labels(opened, arguments).names()}}, arguments.as_json);
    return;
  }
  if (arguments.out.empty()) throw UsageError("--out FOLDER is missing");
  CheckReplacedFolder(arguments.out, kEditKind, InputsOf(arguments, folder));
  const deform::OpenedModel opened = deform::OpenCodeModel(folder);
  log::Info("Editing by {} ({}, codes of {} numbers)", folder.string(), opened.kind, opened.model->num_numbers());
  EditFaces edit(opened, arguments);
  edit.AddAll();
  MeasureFaces(*opened.model, edit.faces());
  EditContent content = std::move(edit).Take();
  content.model = {{"name", opened.name},
                   {"kind", opened.kind},
                   {"data_hash", opened.data_hash},
                   {"numbers", opened.model->num_numbers()},
                   {"usual_radius", opened.model->usual_radius()}};
  content.writes_ply = arguments.writes_ply;
  content.manifest.verb = "edit";
  content.manifest.seed = arguments.seed;
  content.manifest.sources = opened.sources;
  Json result = WriteEdit(arguments.out, *opened.model, content);
  result["seconds"] = watch.seconds();
  PrintResult(arguments.as_json ? result : ByName(result), arguments.as_json);
}

void AddStartArguments(CLI::App& command, EditStartArguments& start) {
  command.add_option("--face", start.face,
                     "Begin with this face: a mesh (.obj, .ply) of the model's topology, or FOLDER/NAME of a face in a "
                     "database. Without it, --landmarks or --code: the mean face");
  command
      .add_option("--mesh-landmarks", start.mesh_landmarks,
                  "68 landmarks of the mesh of --face, which may then be of any topology: it is registered first")
      ->check(CLI::ExistingFile);
  command
      .add_option("--landmarks", start.landmarks,
                  "Begin with the face that has these 68 landmarks in a picture (docs/formats.md lists the forms; nan "
                  "nan: absent)")
      ->check(CLI::ExistingFile);
  command
      .add_option("--picture", start.picture,
                  "The picture of --landmarks, for the sheet; alone: begin with its face, by landmarks that the "
                  "shipped weights find")
      ->check(CLI::ExistingFile);
  command.add_option("--code", start.code, "Begin with a face of an earlier edit: edit.json, or edit.json#NAME");
}

}  // namespace

Verb EditVerb() {
  return {
      "edit", "Faces by a deformable model: from meshes and landmarks, moved by handles and labels, exaggerated",
      [](CLI::App& command) {
        auto arguments = std::make_shared<EditArguments>();
        command.add_option("model", arguments->model,
                           "A run of the task `deform`, or a folder of faces, of which principal components are "
                           "taken. Without it: the shipped face model with controls of caricature");
        AddStartArguments(command, arguments->start);
        command
            .add_option(
                "--random", arguments->random,
                "Add this number of random faces of the model; neutral ones where it has an expression of its own")
            ->check(CLI::Range(1, 1000));
        command.add_option("--seed", arguments->seed, "Of --random")->capture_default_str();
        command
            .add_option(
                "--spread", arguments->spread,
                "Of --random: deviation of the numbers of a code; 1 is that of the model's own faces, each "
                "number for itself: of models without training many controls at once, which few caricatures have")
            ->check(CLI::Range(0.01, 3.0))
            ->capture_default_str();
        command.add_option("--toward", arguments->toward, "Interpolate to this face, given as --face is");
        command
            .add_option("--handle", arguments->handles,
                        "Move a point by centimetres: 30=0,0,1 (a landmark), v1200=0,0.5,0 (a vertex), or a preset: "
                        "nose=1, chin=1, cheeks=1, ears=1. May be repeated")
            ->allow_extra_args(false);
        command.add_flag("--local", arguments->is_local, "Hold the parts of the face that have no handle");
        command
            .add_option("--soft", arguments->soft_cm,
                        "Deviation of handles from their targets, cm; without it they are held to 5 % of their move")
            ->check(CLI::PositiveNumber);
        command.add_flag("--expression", arguments->moves_expression,
                         "Handles may change the expression, where the model has one of its own");
        command.add_flag("--arap", arguments->with_arap,
                         "Add the same handles by as-rigid-as-possible deformation, without the model");
        command
            .add_option("--label", arguments->labels,
                        "Raise a label by deviations: nose_size=1.5. May be repeated. --list-labels prints them")
            ->allow_extra_args(false);
        command.add_option("--keep", arguments->keep, "Labels that --label is not to change")
            ->delimiter(',')
            ->allow_extra_args(false);
        command.add_option(
            "--labelled", arguments->labelled_faces,
            "Folder of faces with labels: controls, expressions, caricature. Without it that of the model");
        command.add_option("--labels", arguments->label_file, "CSV of labels of these faces: name,LABEL,...")
            ->check(CLI::ExistingFile);
        command.add_flag("--list-labels", arguments->lists_labels, "Print the labels and end");
        command.add_option("--caricature", arguments->caricature,
                           "Exaggerate the face's deviation from the mean by this share, and move it along the "
                           "direction from regular faces to caricatures where faces are labelled");
        command.add_option("--steps", arguments->steps, "Faces of an edit, from a share of it to the whole")
            ->check(CLI::Range(1, 100))
            ->capture_default_str();
        command.add_option("-o,--out", arguments->out, "Folder to write");
        command.add_flag("--ply", arguments->writes_ply, "Write PLY as well");
        command.add_flag("--json", arguments->as_json, "Print the result as JSON");
        return [arguments] { Edit(*arguments); };
      },
      /*keeps_freed_memory=*/false};
}

}  // namespace daumier::cli
