#include "cli/verb.h"
#include "core/output_place.h"
#include "systems/deform/import_authors_model.h"

#include <fmt/core.h>

#include <memory>

namespace daumier::cli {

Verb ImportVerb() {
  return {"import", "Make a run of another program's deformable model: the authors' checkpoint",
          [](CLI::App& command) {
            struct Arguments {
              deform::AuthorsFiles files;
              std::filesystem::path out;
              bool as_json = false;
            };
            auto arguments = std::make_shared<Arguments>();
            command
                .add_option("checkpoint", arguments->files.checkpoint,
                            "The authors' checkpoint: .pth of PyTorch (torch.save), or its tensors as .safetensors")
                ->required();
            command
                .add_option("--template", arguments->files.template_mesh,
                            "The authors' template, in the coordinates that the network reads: .obj or .ply")
                ->required();
            command
                .add_option("--annotation", arguments->files.annotation,
                            "JSON file with 68 landmarks and the hairline of the template's vertices, and cm_per_unit "
                            "(10 where it is absent)")
                ->required();
            command.add_option("--licence", arguments->files.licence, "Licence of these files, copied to the manifest");
            command.add_option("-o,--out", arguments->out, "Folder to write, a run")->required();
            command.add_flag("--json", arguments->as_json, "Print the result as JSON");
            return [arguments] {
              CheckReplacedFolder(
                  arguments->out, "run",
                  {arguments->files.checkpoint, arguments->files.template_mesh, arguments->files.annotation});
              PrintResult(deform::ImportAuthorsModel(arguments->files, arguments->out), arguments->as_json);
              if (!arguments->as_json) fmt::print("run: {}\n", arguments->out.string());
            };
          },
          /*keeps_freed_memory=*/false};
}

}  // namespace daumier::cli
