#include "cli/edit_faces.h"
#include "cli/verb.h"
#include "core/error.h"
#include "core/log.h"
#include "core/output_place.h"
#include "core/stopwatch.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

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
  std::vector<fs::path> inputs = {
      model,         start.face,       start.mesh_landmarks,     start.landmarks,     start.landmark_vertices,
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
    PrintResult({{"labels", LabelNames(opened, arguments)}}, arguments.as_json);
    return;
  }
  if (arguments.out.empty()) throw UsageError("--out FOLDER is missing");
  CheckReplacedFolder(arguments.out, kEditKind, InputsOf(arguments, folder));
  const deform::OpenedModel opened = deform::OpenCodeModel(folder);
  log::Info("Editing by {} ({}, codes of {} numbers)", folder.string(), opened.kind, opened.model->num_numbers());
  EditContent content = MakeEdit(opened, arguments);
  MeasureFaces(*opened.model, content.faces);
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
                  "Begin with the face that has these landmarks in a picture: 68, or 81 with dlib's 13 points of the "
                  "forehead (docs/formats.md lists the forms; nan nan: absent)")
      ->check(CLI::ExistingFile);
  command
      .add_option("--landmark-vertices", start.landmark_vertices,
                  "A file with a vertex of the template for each point of --landmarks, which may then be any set; -1: "
                  "the template has none")
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
                        "Move a point by centimetres: 30=0,0,1 (a landmark), v1200=0,0.5,0 (a vertex), "
                        "t400:0.2,0.3=0,1,0 (the point of a triangle with these shares of its second and third corner; "
                        "t400: its middle), or a preset: nose=1, chin=1, cheeks=1, ears=1. May be repeated")
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
                        "Raise a label by deviations: nose_size=1.5. May be repeated. --list-labels prints them. "
                        "FILE.npy=1.5: along a direction of the model's own codes")
            ->allow_extra_args(false);
        command
            .add_option("--label-method", arguments->label_method,
                        "How the direction of a label is found: means, the difference of the mean faces with and "
                        "without it; svm, across the plane that parts them best")
            ->check(CLI::IsMember({"means", "svm"}))
            ->capture_default_str();
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
        command.add_flag("--texture", arguments->is_textured,
                         "Paint the faces from --picture: a UV atlas texture.png, to which the .obj of each refers; "
                         "with --code, the atlas of that edit");
        command.add_option("--texture-size", arguments->texture_size, "Side of the atlas, texels")
            ->check(CLI::Range(64, 4096))
            ->capture_default_str();
        command.add_option("-o,--out", arguments->out, "Folder to write");
        command.add_flag("--ply", arguments->writes_ply, "Write PLY as well");
        command.add_flag("--json", arguments->as_json, "Print the result as JSON");
        return [arguments] { Edit(*arguments); };
      },
      /*keeps_freed_memory=*/false};
}

}  // namespace daumier::cli
