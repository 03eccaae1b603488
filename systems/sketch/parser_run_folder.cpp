#include "systems/sketch/parser_run_folder.h"

#include "core/error.h"
#include "core/run_manifest.h"
#include "core/weights_folder.h"

namespace daumier::sketch {

ParserRunFolder ReadParserRunFolder(const std::filesystem::path& directory) {
  ParserRunFolder run;
  run.directory = directory;
  run.manifest = ReadFinishedRun(directory, kParserSystem);
  run.config = ReadRunConfig(directory, run.manifest);
  const std::string file = ResolvedConfig(directory).string();
  DAUMIER_CHECK(run.config.contains("network"), "{} has no table 'network': it is not the config of a parser's run",
                file);
  run.network_options = ParseOptions<ParserNetworkOptions>(run.config["network"], file);
  return run;
}

ParserNetworkOptions ReadParserNetworkOptions(const std::filesystem::path& run_or_weights) {
  if (!IsWeightsFolder(run_or_weights)) return ReadParserRunFolder(run_or_weights).network_options;
  const Manifest manifest = ReadWeights(run_or_weights, kParserSystem, {kWeightsNetwork});
  return ParseOptions<ParserNetworkOptions>(manifest.details.value("network", Json::object()),
                                            (run_or_weights / "manifest.json").string());
}

}  // namespace daumier::sketch
