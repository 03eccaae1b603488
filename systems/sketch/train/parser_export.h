#pragma once
#include "export/run_export.h"
#include "models/heat_map_unet.h"
#include "systems/sketch/drawing_parser.h"

#include <filesystem>

namespace daumier::sketch {

/// The network as a function of `pictures` (N, 1, R, R) of ink to `heat_maps` (N, 26, R / 4, R / 4), `labels`
/// (N, 14, R / 2, R / 2) and `states` (N, 11), scores before any softmax (models/heat_map_unet.h).
exporting::ExportedFunction ParserFunction(models::HeatMapUnet network, const ParserNetworkOptions& options);

/// The network of shipped weights, without their numbers. network: ParserNetworkOptions. @throws Error as ParseOptions
/// and MakeParserNetwork.
exporting::NetworkFunction MakeParserFunction(const Json& network);

/// The export of a finished run. @throws Error as LoadParserRun.
exporting::RunExport DescribeParserExport(const std::filesystem::path& run_directory);

/// The parser of a finished run or of shipped weights, run by LibTorch on the CPU: OpenDrawingParser without the training
/// library, of which this room is a part. @throws Error as ReadParserNetworkOptions, LoadParserRun and ReadWeights.
DrawingParser OpenParserOfRun(const std::filesystem::path& run_or_weights);

}  // namespace daumier::sketch
