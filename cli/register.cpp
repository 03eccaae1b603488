#include "cli/template_choice.h"
#include "cli/verb.h"
#include "core/error.h"
#include "core/files.h"
#include "core/options.h"
#include "core/output_place.h"
#include "core/process_task.h"
#include "datasets/build/registered_faces.h"
#include "datasets/build/sharded_build.h"
#include "datasets/gallery/registration_pictures.h"

#include <memory>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

struct RegisterArguments {
  datasets::MeshInputs inputs;
  ConfigArguments config;
  std::string template_name = "makehuman";
  fs::path out;
  std::string licence;
  bool zero_is_absent = false, write_meshes = false, write_pictures = true, as_json = false;
};

void Register(RegisterArguments arguments) {
  arguments.inputs.zero = arguments.zero_is_absent ? faces::ZeroPoints::kAbsent : faces::ZeroPoints::kPlaces;
  Json config = arguments.config.Load();
  const TemplateChoice choice = ChooseTemplate(arguments.template_name);
  if (choice.folder.empty()) config["source"]["name"] = choice.source;
  if (!arguments.licence.empty()) config["licence"] = arguments.licence;
  const auto options = ParseOptions<datasets::RegisterOptions>(config, arguments.config.Where());
  std::vector<fs::path> read = arguments.inputs.meshes;
  read.insert(read.end(),
              {arguments.inputs.landmarks, arguments.inputs.vertex_map, options.source.path, choice.folder});
  CheckOutputFolder(arguments.out, datasets::BuildOutput("faces"), read);
  const auto face_template = datasets::RegistrationTemplateOf(options, choice.folder);
  const auto failed =
      datasets::BuildRegisteredFaces(face_template, arguments.inputs, options, arguments.out, TaskOfProcess());
  const faces::FaceDatabase database(arguments.out);
  if (arguments.write_meshes) {
    MakeDirectory(arguments.out / "meshes");
    datasets::WriteRegisteredMeshes(database, arguments.out / "meshes");
  }
  if (arguments.write_pictures) {
    MakeDirectory(arguments.out / "pictures");
    datasets::WriteRegistrationPictures(database, arguments.inputs, arguments.out / "pictures");
  }
  PrintResult(ReadJson(arguments.out / "quality.json").at("summary"), arguments.as_json);
  if (!failed.empty()) throw Error(datasets::ListFailures(failed, arguments.inputs.meshes.size()));
}

}  // namespace

Verb RegisterVerb() {
  return {
      "register", "Bring a template onto head meshes with 68 landmarks: a database of faces", [](CLI::App& command) {
        auto arguments = std::make_shared<RegisterArguments>();
        command.add_option("inputs", arguments->inputs.meshes, "OBJ or PLY meshes, or key=value options")->required();
        command
            .add_option(
                "--landmarks", arguments->inputs.landmarks,
                "68 landmarks in iBUG order, or the 51 without the contour. Either one file with vertex indices "
                "(0-based, -1: absent) for all meshes of one topology, or a folder with a file for each mesh: "
                "NAME.txt, "
                ".json, .pts, .pp, .csv, .tsv, .fcsv, .mrk.json or .xml, with vertex indices or with x y z (nan nan "
                "nan: "
                "absent). docs/formats.md lists the forms")
            ->required();
        command.add_flag("--zero-is-absent", arguments->zero_is_absent,
                         "Landmarks at 0 0 0, or at vertex 0, count as absent");
        command.add_option("--vertex-map", arguments->inputs.vertex_map,
                           "File whose line i is the number of vertex i of the meshes in the landmark file");
        command.add_option("--template", arguments->template_name,
                           "makehuman, ict (with source.path=...), or a folder of faces, whose template is used");
        command.add_option("--licence", arguments->licence, "Licence of the meshes, copied to the manifest");
        command.add_option("--config", arguments->config.file, "TOML file of options; key=value overrides it");
        command.add_option("-o,--out", arguments->out, "Folder to write; resumes an interrupted build")->required();
        command.add_flag("--meshes", arguments->write_meshes, "Also write meshes/NAME.obj");
        command.add_flag_callback(
            "--no-pictures", [arguments] { arguments->write_pictures = false; }, "Write no pictures/NAME.jpg");
        command.add_flag("--json", arguments->as_json, "Print the summary as JSON");
        command.footer("Options:\n" + HelpText<datasets::RegisterOptions>());
        return [arguments] {
          // key=value follow the meshes.
          auto& meshes = arguments->inputs.meshes;
          for (const fs::path& word : meshes) {
            if (word.string().find('=') != std::string::npos) arguments->config.overrides.push_back(word.string());
          }
          std::erase_if(meshes, [](const fs::path& word) { return word.string().find('=') != std::string::npos; });
          Register(*arguments);
        };
      }};
}

}  // namespace daumier::cli
